#pragma once

#include "models/simplify/polish_target.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <cstddef>

namespace octant::models::simplify {

/// How much work turn_back may do and what it may cost.
struct TurnOptions {
    int rounds = 8;
    double most_growth = 0.01;     ///< The root mean square distance may grow by this share.
    std::size_t samples = 30'000;  ///< Samples by area; long thin triangles get more.
    std::size_t looks = 1'000'000; ///< It ends after this many sample distances.
};

/// Turns triangles back that are folded over (measure::flipped_area_share): moves vertices as long
/// as there is less of such area, distances hardly grow and the largest ones do not. Each tracked
/// point must be in the list of a triangle that is near.
void turn_back(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const TurnOptions& options);

} // namespace octant::models::simplify
