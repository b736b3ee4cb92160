#pragma once

#include "ui/settings/settings.h"
#include "ui/world/path_placement.h"

#include <cstddef>
#include <vector>

namespace octant::ui::world {

/// When the pictures of a run are taken.
struct PictureTimes {
    /// At least one.
    std::vector<double> times_s;
    double rate_hz = 0.0;
    /// The time of the last simulation step of the run.
    double last_step_s = 0.0;

    /// Keeps the first `frames` (>= 1) times, or all if there are no more.
    void truncate_to(std::size_t frames);
};

/// Throws Error if the run would start after the path's end.
PictureTimes picture_times_of(const settings::RunSettings& settings, const PlacedFlight& flight);

} // namespace octant::ui::world
