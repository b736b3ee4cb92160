#pragma once

#include "ui/settings/settings.h"
#include "ui/world/world.h"

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

    /// Leaves the first so many, at least one; does nothing where there are no more.
    void truncate_to(std::size_t frames);
};

/// Throws Error when the run would start behind the path's end.
PictureTimes picture_times_of(const settings::RunSettings& settings, const Flight& flight);

} // namespace octant::ui::world
