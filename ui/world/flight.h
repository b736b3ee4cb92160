#pragma once

#include "flightpaths/fly_script.h"
#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/base/ground_height.h"
#include "sim/trajectory.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/settings.h"
#include "ui/world/scene_ground.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <map>
#include <memory>
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
    /// Of a recording with several aircraft, those that fly beside this one, in its axes and by its clock, and the
    /// built-in aircraft that each is shown as.
    std::vector<sim::Trajectory> other_trajectories;
    std::vector<std::string> other_aircraft;
    bool is_acmi_recording = false;
};

/// What an aircraft of this shape flies by a path's name or file. Throws Error.
LoadedPath load_path(const std::string& path, const std::string& shape, bool lenient);

/// A path as it is flown over the ground of a run.
struct Flight {
    /// States in world axes.
    sim::Trajectory trajectory;
    std::string title;
    /// Samples a second.
    double rate_hz = 20.0;
    /// Where the path's origin lies.
    glm::dvec2 place_m{0.0};
    /// How far the path was turned, clockwise.
    double heading_rad = 0.0;
    /// How far the path was lifted.
    double offset_m = 0.0;
    /// The least height above the ground, and when it is flown at.
    double lowest_clearance_m = 0.0;
    double lowest_clearance_s = 0.0;
    std::vector<flightpaths::LegStart> legs;
    /// Of aircraft that fly a path of their own, by their numbers and by the first one's clock, in world axes; before
    /// its start and after its end such an aircraft is not there.
    std::map<std::size_t, sim::Trajectory> other_trajectories;
};

/// Where --place puts the path's origin, metres east and north of the map centre. Two numbers are degrees when they
/// carry letters (49.3N,123.1W) or when the map has a place on the earth and they lie on it as latitude,longitude;
/// otherwise metres. `map_frame` is null for a map without one. Throws Error for other text and for degrees on a map
/// without a place.
glm::dvec2 path_origin_from_text(const std::string& text, const EarthFrame* map_frame, const glm::dvec2& half_extent_m);

/// Before anything is loaded: throws Error where path_origin_from_text would for this ground whatever its extent. Reads
/// no more of a map than where it lies.
void check_path_origin(const settings::PathSettings& settings);

/// The first aircraft's path: its own, or that of the settings.
std::string path_of(const settings::RunSettings& settings);

/// Where a path has been laid before.
struct PathPlacement {
    glm::dvec2 place_m{0.0};
    double heading_rad = 0.0;
};

/// What laying a path over a ground asks of it.
struct PlacementGround {
    GroundHeight height_at;
    glm::dvec2 half_extent_m{0.0};
    /// How it lies on the earth; null for made ground.
    std::shared_ptr<const EarthFrame> frame;
};

/// It refers to the ground.
PlacementGround placement_ground(const SceneGround& ground);

/// Where the first aircraft stands that others fly, until somebody moves it. Throws Error.
Flight live_flight(const settings::RunSettings& settings, const PlacementGround& ground);

/// Lays the first aircraft's path over the ground, and with it all that a recording has beside it. Adds what a person
/// should be told to the notes. `given_placement`: there, and not where settings and ground say. Throws Error.
Flight place_flight(const settings::RunSettings& settings, LoadedPath loaded, const PlacementGround& ground,
    std::vector<std::string>& notes, const std::optional<PathPlacement>& given_placement = std::nullopt);

/// An aircraft's own path over the ground: it begins at this place, turned as the first one's, unless it knows where it
/// was flown. Throws Error.
sim::Trajectory own_path(const settings::RunSettings& settings, const settings::AircraftEntry& flown,
    const glm::dvec2& begin_m, const PlacementGround& ground, const Flight& first, std::vector<std::string>& notes);

} // namespace octant::ui::world
