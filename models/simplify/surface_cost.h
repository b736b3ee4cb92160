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

    /// The sum over the points of weight times squared distance to the set triangles, less the
    /// present sum. Stops early once it exceeds `enough` and returns what it has then.
    double increase(double enough = std::numeric_limits<double>::infinity());

    /// The sum over the points of weight times squared distance to the set triangles.
    double total();

    /// A total this small may be nothing but the rounding of the points.
    double negligible() const;

    /// The cost in the opposite direction: the area of the new triangles times the squared distance
    /// from their centres to the nearest point, as far as that exceeds the spacing of the points.
    double way_back(
        const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place);

    const PointBlock& block() const { return block_; }

    std::vector<FlatTriangle> triangles;

private:
    double area() const; ///< The area that the points stand for.

    PointBlock block_;
    double cost_now_ = 0.0;
    bool coloured_ = false;
};

} // namespace octant::models::simplify
