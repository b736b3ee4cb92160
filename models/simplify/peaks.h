#pragma once

#include "models/simplify/polish.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

namespace octant::models::simplify {

struct PeakOptions {
    int rounds = 12;
    double most_growth = 0.01; ///< of the root of the mean square, that lower peaks may cost
};

/// Moves vertices and flips edges where the two surfaces are farthest apart, as long as the largest
/// distance seen falls: from the tracked points to the surface and from samples of the surface to
/// the target. The points must be in the lists of triangles that are near.
void lower_peaks(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const PeakOptions& options);

} // namespace octant::models::simplify
