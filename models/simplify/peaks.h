#pragma once

#include "models/simplify/polish_target.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <cstddef>

namespace octant::models::simplify {

/// How much work lower_peaks may do and what it may cost.
struct PeakOptions {
    int rounds = 12;
    /// Lowering the largest distances may make the root mean square grow by this share.
    double most_growth = 0.01;
    /// It ends after this many sample distances, or after looks_a_face for each triangle of the
    /// target, whichever is more.
    std::size_t least_looks = 70'000;
    std::size_t looks_a_face = 12;
    /// At least about so many samples are taken of all triangles, unless there are very high peaks:
    /// between them the distance of few and large ones is up to half as much again as at them.
    std::size_t samples = 0;
};

/// Lowers the largest distance between the two surfaces (the Hausdorff distance as far as it is
/// seen): moves vertices and flips edges where they are farthest apart, as long as that distance
/// falls. Seen are the distances from the tracked points to the surface and from samples of the
/// surface to the target. Each tracked point must be in the list of a triangle that is near.
void lower_peaks(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const PeakOptions& options);

} // namespace octant::models::simplify
