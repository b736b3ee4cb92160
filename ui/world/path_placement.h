#pragma once

#include "flightpaths/fly_script.h"
#include "flightpaths/ground_contact.h"
#include "models/heights/runway_strip.h"
#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/settings.h"
#include "ui/world/path_loader.h"
#include "ui/world/scene_ground.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// The paths of all aircraft of a run over its ground: the first one's, and those of aircraft with a path of their own.
struct PlacedFlight {
    /// States in world axes.
    sim::Trajectory trajectory;
    std::string title;
    /// Samples a second.
    double rate_hz = 20.0;
    /// World position of the origin of the path.
    glm::dvec2 place_m{0.0};
    /// Clockwise turn of the path.
    double heading_rad = 0.0;
    /// Height that was added to the path.
    double offset_m = 0.0;
    /// The least height above the ground, and its time.
    double lowest_clearance_m = 0.0;
    double lowest_clearance_s = 0.0;
    /// What is flown of it; the rest may leave the map.
    double flown_from_s = 0.0;
    double flown_to_s = 0.0;
    std::vector<flightpaths::LegStart> legs;
    /// The first aircraft's name in its recording; empty where there is none.
    std::string name;
    /// Paths of aircraft with a path of their own, by aircraft number, on the first one's clock, in world axes. Before
    /// the start and after the end of its path such an aircraft is absent.
    std::map<std::size_t, sim::Trajectory> other_trajectories;
    /// Names of those that come from a recording, by aircraft number.
    std::map<std::size_t, std::string> other_names;
    /// What the first aircraft's file holds, and what was made of each of its aircraft; null for a path script.
    std::shared_ptr<const flightpaths::TrackRecording> recording;
    std::vector<flightpaths::TrackInference> inferences;
    /// What laying each of these aircraft onto the ground did to its heights; none where nothing was laid.
    std::vector<flightpaths::GroundContactReport> ground_contacts;
};

/// Where --place puts the path's origin, metres east and north of the map centre. Two numbers are degrees when they
/// carry letters (49.3N,123.1W) or when the map has a place on the earth and they lie on it as latitude,longitude;
/// otherwise metres. `map_frame` is null for a map without one. Throws Error for other text and for degrees on a map
/// without a place.
glm::dvec2 path_origin_from_text(const std::string& text, const EarthFrame* map_frame, const glm::dvec2& half_extent_m);

/// Before anything is loaded: throws Error where path_origin_from_text would for this ground whatever its extent. Reads
/// no more of a map than where it lies.
void check_path_origin(const settings::PathSettings& settings);

/// Where a path was placed.
struct PathPlacement {
    glm::dvec2 place_m{0.0};
    double heading_rad = 0.0;
};

/// The ground as placing a path needs it.
struct PlacementGround {
    GroundHeight height_at;
    glm::dvec2 half_extent_m{0.0};
    /// Its axes on the earth; null for generated ground.
    std::shared_ptr<const EarthFrame> frame;
    /// How far each aircraft of the run reaches below its reference point, by aircraft number; a metre where none is
    /// known.
    std::vector<double> reach_below_m{};
};

/// The result must not outlive `ground`.
PlacementGround placement_ground(const SceneGround& ground);

/// The flight of a run whose aircraft other programs fly: the first one waits there until packets move it. Throws
/// Error.
PlacedFlight live_flight(const settings::RunSettings& settings, const PlacementGround& ground);

/// Places the first aircraft's path over the ground, with the other aircraft of its ACMI recording, and appends notes
/// for the user. `given_placement` replaces what the settings and the ground say. Throws Error.
PlacedFlight place_flight(const settings::RunSettings& settings, LoadedPath loaded, const PlacementGround& ground,
    std::vector<std::string>& notes, const std::optional<PathPlacement>& given_placement = std::nullopt);

/// An aircraft's own path over the ground: it begins at this place, turned as the first one's, unless it knows where it
/// was flown. Throws Error.
sim::Trajectory own_path(const settings::RunSettings& settings, const settings::AircraftEntry& flown,
    const glm::dvec2& begin_m, const PlacementGround& ground, const PlacedFlight& first,
    std::vector<std::string>& notes);

/// Finds the runway of a run where its first aircraft begins, along its heading, or near there; null where the settings
/// ask for none. `script`: nothing where others fly the aircraft. When the finder runs it sets `given_placement` to
/// where the path lies over the ground that is not levelled yet. All arguments must outlive the finder.
RunwayFinder make_runway_finder(const settings::RunSettings& settings, const std::optional<LoadedPath>& script,
    std::optional<PathPlacement>& given_placement);

/// A finder that returns this runway; null if it is null.
RunwayFinder fixed_runway_finder(std::shared_ptr<const models::heights::RunwayStrip> runway);

} // namespace octant::ui::world
