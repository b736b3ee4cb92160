#pragma once

#include "models/simplify/polish_target.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <cstddef>

namespace octant::models::simplify {

struct PeakOptions {
    int rounds = 12;
    double most_growth = 0.01; ///< of the root of the mean square, that lower peaks may cost
    /// Ends after so many distances of samples, or so many a triangle of the target: the larger.
    std::size_t least_looks = 70'000;
    std::size_t looks_a_face = 12;
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
