#pragma once

#include "models/simplify/peaks.h"
#include "models/simplify/polish_target.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <limits>

namespace octant::models::simplify {

/// How thoroughly a surface is fitted.
struct PolishOptions {
    int rounds = 7;
    int fields = 3;       ///< The number of grid fields along a triangle's side, for samples.
    bool extremes = true; ///< Calls lower_peaks and turn_back at the end.
    PeakOptions peaks;    ///< For lower_peaks.
    /// Vertices of an uncoloured surface may move to where triangles become slivers: along
    /// cylinders and rims those lie best.
    bool slivers_too = false;
    /// No squared distance that is seen rises beyond this, in working units.
    double avoided2 = std::numeric_limits<double>::infinity();
    int threads = 1; ///< The number of threads; it does not change the result.
};

/// Fits a simplified surface to the target: moves vertices, changes their colours and flips edges
/// as long as the sum of squared distances falls, from the tracked points to the surface and from
/// samples of the surface to the target. Each tracked point must be in the list of a triangle that
/// is near.
void polish(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const PolishOptions& options);

} // namespace octant::models::simplify
