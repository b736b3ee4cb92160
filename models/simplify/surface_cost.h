#pragma once

#include "models/simplify/point_block.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A triangle of the surface as it is now, with its colours where there are any.
FlatTriangle flat(const WorkingSurface& surface, std::uint32_t face);

/// What a change around an edge or a vertex costs: the squared distances of the tracked points
/// whose triangles change, to the triangles as they would be.
class SurfaceCost {
public:
    /// Loads the tracked points of these triangles.
    void gather(const TrackedPoints& points, std::span<const std::uint32_t> faces);

    /// Sets the triangles as they would be: those of the ring with their moving corner at `place`
    /// and its colour `colour`, which counts where the surface has colours.
    void set_triangles(
        const WorkingSurface& surface,
        std::span<const RingFace> ring,
        const glm::dvec3& place,
        const glm::dvec3& colour);

    /// The sum over the points of weight times squared distance to the set triangles.
    double total();

    /// The same less the present sum.
    double increase() { return total() - cost_now_; }

    /// The largest squared distance of a point to the set triangles, as total() or increase() saw
    /// it last.
    double most2() const;

    /// The area that the points stand for.
    double area() const;

    /// A total this small may be nothing but the rounding of the points.
    double negligible() const;

    /// The cost in the opposite direction: the area of the new triangles times the squared distance
    /// from their centres to the nearest point, as far as that exceeds the spacing of the points.
    double way_back(
        const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place);

    const PointBlock& block() const { return block_; }

    std::vector<FlatTriangle> triangles;

private:
    PointBlock block_;
    double cost_now_ = 0.0;
    bool coloured_ = false;
};

} // namespace octant::models::simplify
