#pragma once

#include "flightpaths/fly_script.h"
#include "sim/aircraft_limits.h"
#include "sim/base/geo_position.h"
#include "sim/trajectory.h"
#include "ui/settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// A path or a recorded track as its file gives it, before it is laid over ground.
struct LoadedPath {
    sim::Trajectory trajectory;
    double rate_hz = 0.0;
    double min_clearance_m = 0.0;
    /// Those of what flies, where they are known.
    std::optional<sim::AircraftLimits> limits;
    /// That of a track which knows where it was flown: its axes are a TransverseMercator frame's there.
    std::optional<GeoPosition> origin;
    std::vector<flightpaths::LegStart> legs;
    std::vector<std::string> notes;
    /// Of a tape with several aircraft, those that fly beside this one, in its axes and by its clock, and the built-in
    /// aircraft that each is shown as.
    std::vector<sim::Trajectory> other_trajectories;
    std::vector<std::string> other_aircraft;
    bool is_tape = false;
};

/// What an aircraft of this shape flies by a path's name or file. Throws Error.
LoadedPath load_path(const std::string& path, const std::string& shape, bool lenient);

} // namespace octant::ui::world
