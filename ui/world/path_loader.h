#pragma once

#include "flightpaths/fly_script.h"
#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"
#include "ui/settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// A path or a recorded track as its file gives it, before it is placed over ground.
struct LoadedPath {
    sim::Trajectory trajectory;
    double rate_hz = 0.0;
    double min_clearance_m = 0.0;
    /// Of the aircraft, where its type is known.
    std::optional<sim::AircraftLimits> limits;
    /// Geographic origin of a track with positions; its axes are those of the TransverseMercator frame there.
    std::optional<GeoPosition> origin;
    std::vector<flightpaths::LegStart> legs;
    std::vector<std::string> notes;
    /// The other aircraft of an ACMI recording, in the axes and on the clock of the first one, and the built-in
    /// aircraft that shows each of them.
    std::vector<sim::Trajectory> other_trajectories;
    std::vector<std::string> other_aircraft;
    bool is_acmi_recording = false;
};

/// Loads a path by its name or file for an aircraft of this shape. Throws Error.
LoadedPath load_path(const std::string& path, const std::string& shape, bool lenient);

/// The first aircraft's path: its own, or that of the settings.
std::string path_of(const settings::RunSettings& settings);

} // namespace octant::ui::world
