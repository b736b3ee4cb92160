#pragma once

#include "models/measure/target_surface.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::measure {

/// How far a search for the largest distance goes.
struct HausdorffLimits {
    double tightness = 1.01;                  ///< ends when most <= tightness * least ...
    double negligible_m = 0.0;                ///< ... or most <= this ...
    std::size_t cuts = std::size_t{1} << 22U; ///< ... or after so many cuts, bounds still certified
    int threads = 1;                          ///< changes nothing of the result
};

/// The largest distance of a point of a surface to another surface lies between these.
struct HausdorffBounds {
    double least_m = 0.0;
    double most_m = 0.0;
    std::size_t cuts = 0; ///< how many it took
};

/// Bounds of the largest distance from the points of `mesh`'s triangles to `target`, rounding
/// allowed for.
HausdorffBounds one_way_hausdorff(
    const TriangleMesh& mesh, const TargetSurface& target, const HausdorffLimits& limits);

} // namespace octant::models::measure
