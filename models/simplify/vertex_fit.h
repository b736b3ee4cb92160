#pragma once

#include "models/simplify/sample_block.h"
#include "models/simplify/quadric.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace octant::models::simplify {

/// How much the distance along the triangle counts, beside that across it. 0 would be a
/// Gauss-Newton step (point-to-plane); 1 the slower convergence of iterated closest points.
inline constexpr double sideways = 0.1;

/// A least-squares fit of one vertex: the step of its position, and the change of its colour, that
/// lessen a sum of squared distances most, as far as distances are linear functions of both.
class VertexFit {
public:
    /// Adds a pair of a point and its nearest point on a triangle whose corner 0 is the vertex.
    /// `off` runs from the nearest point to the point; `share` is the vertex's barycentric weight
    /// in the nearest point; `normal` is the triangle's unit normal.
    void add(const glm::dvec3& off, const glm::dvec3& normal, double share, double weight);

    /// Adds the colour of such a pair. `off` is the point's colour less that of the nearest point,
    /// and `gradient` how the latter grows with position on the triangle.
    void add_colour(
        const glm::dvec3& off,
        const std::array<glm::dvec3, 3>& gradient,
        double share,
        double weight);

    /// The step of the position.
    glm::dvec3 way() const;

    /// The change of the colour.
    glm::dvec3 colour_change() const;

private:
    Quadric matrix_;
    glm::dvec3 right_side_{0.0};
    double colour_weight_ = 0.0;
    glm::dvec3 colour_sum_{0.0};
};

/// Adds sample `i` of a block after find_nearest; `triangle` is its nearest one.
void add_sample(
    VertexFit& fit,
    const SampleBlock& samples,
    std::size_t i,
    const FlatTriangle& triangle,
    double weight,
    bool coloured);

} // namespace octant::models::simplify
