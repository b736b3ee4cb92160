#pragma once

#include "models/simplify/point_block.h"
#include "models/simplify/quadric.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace octant::models::simplify {

/// How much of the distance along the triangle counts: none would be a Gauss-Newton step, all of it
/// the slower one of iterated closest points.
inline constexpr double sideways = 0.1;

/// The way of one vertex, and change of its colour, that lessen a sum of squared distances most,
/// as far as distances are linear functions of them.
class VertexFit {
public:
    /// A point with the nearest place of a triangle whose corner 0 is the vertex. `off`: from that
    /// place to the point; `share`: of the vertex in that place; `normal`: of the triangle.
    void add(const glm::dvec3& off, const glm::dvec3& normal, double share, double weight);

    /// The colour of the point less the colour at its nearest place, and how the latter grows with
    /// place on the triangle.
    void add_colour(
        const glm::dvec3& off,
        const std::array<glm::dvec3, 3>& gradient,
        double share,
        double weight);

    glm::dvec3 way() const;

    glm::dvec3 colour_change() const;

private:
    Quadric matrix_;
    glm::dvec3 right_side_{0.0};
    double colour_weight_ = 0.0;
    glm::dvec3 colour_sum_{0.0};
};

/// Adds a point of a block after find_nearest, whose nearest triangle is `triangle`.
void add_point(
    VertexFit& fit,
    const PointBlock& points,
    std::size_t i,
    const FlatTriangle& triangle,
    double weight,
    bool coloured);

} // namespace octant::models::simplify
