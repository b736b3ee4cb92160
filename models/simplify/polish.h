#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <cstddef>

namespace octant::models::simplify {

/// The surface that is approached, in working units.
struct PolishTarget {
    const WorkingSurface& surface;
    const measure::TriangleBvh& bvh;
};

struct PolishOptions {
    int rounds = 10;
    int threads = 1; ///< changes no result
};

/// Moves vertices, changes their colours and flips edges as long as the sum of squared distances,
/// from the tracked points to the surface and from samples of the surface to the target, falls. The
/// points must be in the lists of triangles of the surface that are near.
void polish(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const PolishOptions& options);

} // namespace octant::models::simplify
