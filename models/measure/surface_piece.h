#pragma once

#include "models/measure/target_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::models::measure {

/// A point of a surface and its distance from the target.
struct Sample {
    glm::dvec3 point{0.0};
    double distance_m = 0.0;
    std::uint32_t nearest = NearestOnMesh::none; ///< The triangle of the target that is nearest.
};

/// Measures a point. `guess` is a triangle of the target that may be near, or none; it changes the
/// time only.
Sample measured(const TargetSurface& target, const glm::dvec3& point, std::uint32_t guess);

/// The three corners of a triangular piece of a surface.
using Corners = std::array<const Sample*, 3>;

/// Bounds of the largest distance from a piece's points to the target.
struct PieceBounds {
    double least_m = 0.0;
    double most_m = 0.0;
    /// The triangle nearest to the piece's centre, if that was looked for.
    std::uint32_t middle = NearestOnMesh::none;
};

/// Bounds a piece as tightly as is cheap. The bounds are not tightened any further once the upper
/// one is at most `enough_m`.
PieceBounds bounds_of(const TargetSurface& target, const Corners& corners, double enough_m);

/// Where a piece is cut in two: by a line from a point on one edge to the opposite corner.
struct Cut {
    std::size_t edge = 0; ///< The edge from this corner to the next one.
    double along = 0.5;   ///< Where on that edge, 0 to 1.
};

/// Chooses the cut of a piece. The first choice is where it leaves the part of space over one of
/// the triangles nearest to its corners or its centre (`middle`), because the distance to a single
/// triangle then bounds a part well; leaving it by a small part of `enough_m` does not count. The
/// second is where the nearest triangle changes from one corner to the next, and the last the
/// midpoint of the longest edge.
Cut cut_of(
    const TargetSurface& target, const Corners& corners, std::uint32_t middle, double enough_m);

} // namespace octant::models::measure
