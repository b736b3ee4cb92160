#pragma once

#include "models/simplify/polish_target.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

namespace octant::models::simplify {

struct PolishOptions {
    int rounds = 7;
    int fields = 3;       ///< a side, of the grid of samples on each triangle
    bool extremes = true; ///< afterwards lower_peaks and turn_back
    int threads = 1;      ///< changes no result
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
