#pragma once

#include "models/simplify/point_block.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// What changes around an edge or a vertex costs the tracked points whose triangles change.
class SurfaceCost {
public:
    /// Takes the points of these triangles.
    void gather(const TrackedPoints& points, std::span<const std::uint32_t> faces);

    /// The triangles as they would be; colours are taken where the surface has any.
    void set_triangles(
        const WorkingSurface& surface,
        std::span<const RingFace> ring,
        const glm::dvec3& place,
        const glm::dvec3& colour);

    /// Sum over the points of weight times squared distance to the triangles, less what it is now.
    /// Stops as soon as it is larger than `enough` and returns what it has then.
    double increase(double enough = std::numeric_limits<double>::infinity());

    /// Sum over the points of weight times squared distance to the triangles.
    double total();

    /// A total that rounding of the points may make.
    double negligible() const;

    /// What is seen the other way: area of the new triangles times squared distance to the points,
    /// as far as that is more than the points are apart.
    double way_back(
        const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place);

    const PointBlock& block() const { return block_; }

    std::vector<FlatTriangle> triangles;

private:
    double area() const; ///< that the points stand for

    PointBlock block_;
    double cost_now_ = 0.0;
    bool coloured_ = false;
};

} // namespace octant::models::simplify
