#pragma once

#include "flightpaths/fly_script.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"
#include "ui/settings/settings.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Another aircraft of a recording.
struct OtherAircraft {
    /// In the axes and on the clock of the first one.
    sim::Trajectory trajectory;
    /// By which a person knows it.
    std::string name;
    /// The built-in aircraft that shows it.
    std::string shape;
};

/// A path or a recorded track as its file gives it, before it is placed over ground.
struct LoadedPath {
    sim::Trajectory trajectory = sim::Trajectory(std::vector<sim::AircraftState>(1));
    double rate_hz = 0.0;
    double min_clearance_m = 0.0;
    /// Of the aircraft, where its type is known.
    std::optional<sim::AircraftLimits> limits;
    /// Geographic origin of a track with positions; its axes are those of the TransverseMercator frame there.
    std::optional<GeoPosition> origin;
    std::vector<flightpaths::LegStart> legs;
    std::vector<std::string> notes;
    /// The name of the recorded aircraft; empty where its file has none.
    std::string name;
    std::vector<OtherAircraft> others;
    /// What the file holds; null for a path script. Aircraft i of it is aircraft i of the flight; those of further
    /// files
    /// (--track) come after them.
    std::shared_ptr<const flightpaths::TrackRecording> recording;
    /// Of each aircraft of the recording.
    std::vector<flightpaths::TrackInference> inferences;
};

/// Reads a recorded track; of a zip file (KMZ, .zip.acmi) the first file in it that can be one. Throws Error.
flightpaths::TrackRecording load_recording(const std::filesystem::path& file, const std::string& follow = {});

/// The built-in aircraft that shows one of this type in Tacview's words; the first one for any other.
std::string shape_for_type(const std::string& type);

/// The name of a settings' file that the first aircraft flies: its own, or that of the settings.
std::string path_of(const settings::RunSettings& settings);

/// Loads a path by its name or file for an aircraft of this shape. `follow`: the aircraft of a recording that becomes
/// the first. Throws Error.
LoadedPath load_path(const std::string& path, const std::string& shape, bool lenient, const std::string& follow = {});

/// The first aircraft's path with all tracks of the settings (--track) on its clock. Throws Error.
LoadedPath load_paths(const settings::RunSettings& settings);

} // namespace octant::ui::world
