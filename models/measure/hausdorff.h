#pragma once

#include "models/measure/target_surface.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::measure {

/// When the search for the largest distance may end. Whenever it ends, its bounds are certified.
struct HausdorffLimits {
    /// The search ends when the upper bound is at most this many times the lower one.
    double tightness = 1.01;
    /// It also ends when the upper bound is at most this.
    double negligible_m = 0.0;
    /// It ends after so many cuts, too.
    std::size_t cuts = std::size_t{1} << 22U;
    int threads = 1; ///< The number of threads; it does not change the result.
};

/// The largest distance from a point of one surface to another surface lies between these two.
struct HausdorffBounds {
    double least_m = 0.0;
    double most_m = 0.0;
    std::size_t cuts = 0; ///< How many cuts the search took.
};

/// Bounds of the one-sided Hausdorff distance: the largest distance from any point of `mesh`'s
/// triangles to `target`. Rounding is allowed for in both bounds. Both meshes need triangles
/// (asserted).
HausdorffBounds one_way_hausdorff(
    const TriangleMesh& mesh, const TargetSurface& target, const HausdorffLimits& limits);

} // namespace octant::models::measure
