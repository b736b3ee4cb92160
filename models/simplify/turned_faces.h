#pragma once

#include "models/simplify/polish_target.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <cstddef>

namespace octant::models::simplify {

struct TurnOptions {
    int rounds = 8;
    double most_growth = 0.01;     ///< of the root of the mean square, that it may cost
    std::size_t samples = 30'000;  ///< by area; more on long thin triangles
    std::size_t looks = 1'000'000; ///< ends after so many distances of samples
};

/// Moves vertices where the surface faces against the target, see
/// measure::flipped_area_share, as long as there is less of that, distances hardly grow and the
/// largest ones do not. The points must be in the lists of triangles that are near.
void turn_back(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const TurnOptions& options);

} // namespace octant::models::simplify
