#pragma once

#include "models/measure/target_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::models::measure {

/// A point of a surface and how far it is from the target.
struct Sample {
    glm::dvec3 point{0.0};
    double distance_m = 0.0;
    std::uint32_t nearest = NearestOnMesh::none; ///< triangle of the target
};

/// `guess`: a triangle of the target that may be near.
Sample measured(const TargetSurface& target, const glm::dvec3& point, std::uint32_t guess);

/// A triangular piece of a surface.
using Corners = std::array<const Sample*, 3>;

/// Bounds of the largest distance of a piece's points to the target.
struct PieceBounds {
    double least_m = 0.0;
    double most_m = 0.0;
    std::uint32_t middle = NearestOnMesh::none; ///< triangle nearest to its middle, where asked
};

/// As tight as can be had at little cost; not tightened further once `most_m` <= `enough_m`.
PieceBounds bounds_of(const TargetSurface& target, const Corners& corners, double enough_m);

/// Where a piece is cut in two.
struct Cut {
    std::size_t edge = 0; ///< from this corner to the next one
    double along = 0.5;   ///< of the edge, 0..1
};

/// Where the piece leaves the part of space over one of the triangles nearest to its corners or its
/// `middle`, so that distances to one triangle bound a part well; farther out than a part of
/// `enough_m` only. Else where the nearest triangle changes from one corner to the next, or the
/// middle of the longest edge.
Cut cut_of(
    const TargetSurface& target, const Corners& corners, std::uint32_t middle, double enough_m);

} // namespace octant::models::measure
