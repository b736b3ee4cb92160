#include "ui/world/path_placement.h"

#include "flightpaths/derived_motion.h"
#include "flightpaths/placement.h"
#include "models/heights/height_field.h"
#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/settings_check.h"
#include "ui/world/height_loader.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/nature/runway.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const std::string& expected, const std::string& text) {
    throw Error(fmt::format("--place: expected {}, got '{}'", expected, printable(text)));
}

struct Part {
    double value = 0.0;
    /// N, S, E, W or none.
    char letter = '\0';
};

std::optional<Part> part_of(std::string_view text, std::string_view letters) {
    Part part;
    if (!text.empty() && letters.find(text.back()) != std::string_view::npos) {
        part.letter = text.back();
        text.remove_suffix(1);
    }
    const auto number = finite_number(text);
    if (!number || (part.letter != '\0' && *number < 0.0)) { return std::nullopt; }
    part.value = part.letter == 'S' || part.letter == 'W' ? -*number : *number;
    return part;
}

/// X,Y or LAT,LON as they stand in the text.
struct Pair {
    double first = 0.0;
    double second = 0.0;
    /// Whether a letter says that these are degrees.
    bool lettered = false;
};

Pair pair_of(const std::string& text) {
    const auto fields = split_fields(text, ',');
    const auto first = fields.size() == 2 ? part_of(fields[0], "NS") : std::nullopt;
    const auto second = fields.size() == 2 ? part_of(fields[1], "EW") : std::nullopt;
    if (!first || !second || (first->letter == '\0') != (second->letter == '\0')) {
        refuse("X,Y in metres or LAT,LON in degrees", text);
    }
    return {first->value, second->value, first->letter != '\0'};
}

std::optional<GeoPosition> place_of(const settings::PathSettings& settings) {
    const std::string& terrain = settings.terrain;
    if (settings::is_built_in_ground(terrain)) { return std::nullopt; }
    if (settings::is_imported_ground(terrain)) { return visuals::groundfile::open_ground(terrain).metadata().place; }
    return models::heights::HeightSource(models::heights::map_inputs({terrain}), import_options(settings)).place();
}

} // namespace

void check_path_origin(const settings::PathSettings& settings) {
    if (settings.place && pair_of(*settings.place).lettered) {
        constexpr glm::dvec2 any_extent_m(1.0);
        const auto frame = models::heights::frame_of_ground(std::nullopt, place_of(settings));
        path_origin_from_text(*settings.place, frame.get(), any_extent_m);
    }
}

glm::dvec2 path_origin_from_text(
    const std::string& text, const EarthFrame* map_frame, const glm::dvec2& half_extent_m) {
    const Pair pair = pair_of(text);
    const glm::dvec2 as_metres(pair.first, pair.second);
    if (map_frame == nullptr) {
        if (pair.lettered) { refuse("X,Y in metres on a map without a place on the earth", text); }
        return as_metres;
    }
    const bool can_be_degrees = std::abs(pair.first) <= 90.0 && std::abs(pair.second) <= 360.0;
    if (!can_be_degrees) {
        if (pair.lettered) { refuse("latitude up to 90 and longitude up to 360 degrees", text); }
        return as_metres;
    }
    const glm::dvec2 local_m = map_frame->local_from_geo({pair.first, pair.second});
    const bool on_map = std::abs(local_m.x) <= half_extent_m.x && std::abs(local_m.y) <= half_extent_m.y;
    return pair.lettered || on_map ? local_m : as_metres;
}

namespace {

/// Whether a track lies over this ground where it was flown.
bool has_own_origin(const settings::RunSettings& settings, const LoadedPath& loaded, const PlacementGround& ground) {
    return loaded.origin && ground.frame && !settings.path.place;
}

/// A track that lies over this ground where it was flown, in the ground's axes; another one as it is.
LoadedPath in_axes_of(const PlacementGround& ground, const settings::RunSettings& settings, LoadedPath loaded,
    std::vector<std::string>& notes) {
    if (has_own_origin(settings, loaded, ground)) {
        const TransverseMercator own(*loaded.origin);
        const Ellipsoid ellipsoid = ground.frame->origin().ellipsoid;
        if (!ellipsoid.is_earth()) {
            notes.push_back(
                fmt::format("the track's latitudes and longitudes are taken as places on {}", name_of_body(ellipsoid)));
        }
        loaded.trajectory = flightpaths::reprojected(loaded.trajectory, own, *ground.frame);
        for (OtherAircraft& other : loaded.others) {
            other.trajectory = flightpaths::reprojected(other.trajectory, own, *ground.frame);
        }
    }
    return loaded;
}

/// Heights above the ground, and those of tracks that have none, follow it where the aircraft's limits are known.
sim::HeightMode default_height_mode(const LoadedPath& loaded, bool at_its_own_place) {
    const auto heights =
        loaded.recording ? loaded.recording->aircraft.front().heights : flightpaths::HeightKind::Unknown;
    if (heights == flightpaths::HeightKind::Absent || heights == flightpaths::HeightKind::AboveGround) {
        return loaded.limits ? sim::HeightMode::Follow : sim::HeightMode::Clear;
    }
    return at_its_own_place ? sim::HeightMode::Datum : sim::HeightMode::Clear;
}

flightpaths::PlacementOptions placement_of(
    const settings::RunSettings& settings, const LoadedPath& loaded, const PlacementGround& ground) {
    flightpaths::PlacementOptions placement;
    const bool at_its_own_place = has_own_origin(settings, loaded, ground);
    if (settings.path.place) {
        placement.place_m = path_origin_from_text(*settings.path.place, ground.frame.get(), ground.half_extent_m);
    } else if (at_its_own_place) {
        placement.place_m = ground.frame->local_from_geo(*loaded.origin);
        placement.heading_rad = 0.0;
    }
    if (settings.path.heading_deg) { placement.heading_rad = rad_from_deg(*settings.path.heading_deg); }
    placement.mode = settings.path.height_mode.value_or(default_height_mode(loaded, at_its_own_place));
    if (placement.mode == sim::HeightMode::Follow && !loaded.limits) {
        throw Error(fmt::format("--height-mode follow: expected an aircraft with known limits beside a recorded track, "
                                "got '{}'",
            printable(settings::aircraft_shape(settings.path.aircraft.front()))));
    }
    return placement;
}

void add(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

/// The times between which a run flies this path.
struct FlownPart {
    double from_s = 0.0;
    double to_s = 0.0;
};

FlownPart flown_part(const settings::TimeSettings& time, const sim::Trajectory& path) {
    FlownPart part{path.start_s() + time.start_s, path.end_s()};
    if (time.seconds) { part.to_s = std::min(part.to_s, part.from_s + *time.seconds); }
    if (time.frames && !time.frame_per_sample) {
        part.to_s = std::min(part.to_s, part.from_s + static_cast<double>(*time.frames) / time.rate_hz);
    }
    return part;
}

/// The ground below a track whose origin lies at `place_m`, in the track's axes.
GroundHeight ground_below(const PlacementGround& ground, const glm::dvec2& place_m) {
    return [&ground, place_m](double x_m, double y_m) { return ground.height_at(x_m + place_m.x, y_m + place_m.y); };
}

/// The track between two times of it.
sim::Trajectory cut_to(const FlownPart& part, const sim::Trajectory& track) {
    std::vector<sim::AircraftState> states{track.state_at(part.from_s)};
    for (const sim::AircraftState& state : track.samples()) {
        if (state.time_s > part.from_s && state.time_s < part.to_s) { states.push_back(state); }
    }
    if (part.to_s > part.from_s) { states.push_back(track.state_at(part.to_s)); }
    return sim::Trajectory(std::move(states));
}

/// The longest part of a track below which there is ground at every second; nothing where there is none.
std::optional<FlownPart> longest_part_over(const GroundHeight& ground, const sim::Trajectory& track) {
    constexpr double step_s = 1.0;
    std::optional<FlownPart> best;
    std::optional<FlownPart> now;
    for (double time_s = track.start_s(); time_s <= track.end_s(); time_s += step_s) {
        const glm::dvec3 place_m = track.state_at(time_s).position_m;
        const auto height_m = ground(place_m.x, place_m.y);
        if (!height_m || !std::isfinite(*height_m)) {
            now.reset();
            continue;
        }
        if (!now) { now = FlownPart{time_s, time_s}; }
        now->to_s = time_s;
        if (!best || now->to_s - now->from_s > best->to_s - best->from_s) { best = now; }
    }
    return best && best->to_s > best->from_s ? best : std::nullopt;
}

/// --over-map: keeps the longest part of the first aircraft's track that lies over the map. Throws Error where there is
/// none, and for paths that lie nowhere.
void keep_part_over_map(const settings::RunSettings& settings, const PlacementGround& ground, const glm::dvec2& place_m,
    LoadedPath& loaded, std::vector<std::string>& notes) {
    if (!settings.path.over_map) { return; }
    if (!has_own_origin(settings, loaded, ground)) {
        throw Error("--over-map: expected a track with latitudes and longitudes over a map with a place on the earth, "
                    "and no --place");
    }
    const auto part = longest_part_over(ground_below(ground, place_m), loaded.trajectory);
    if (!part) { throw Error("--over-map: expected a track that crosses the map, got one beside it"); }
    if (part->from_s <= loaded.trajectory.start_s() && part->to_s + 1.0 > loaded.trajectory.end_s()) { return; }
    notes.push_back(fmt::format("of the track the part over the map is flown, from {:.0f} s to {:.0f} s of it",
        part->from_s - loaded.trajectory.start_s(), part->to_s - loaded.trajectory.start_s()));
    loaded.trajectory = cut_to(*part, loaded.trajectory);
}

/// Lays the aircraft of a recording onto the ground over which they were flown, unless the settings say how heights are
/// meant. Returns what was done to each.
std::vector<flightpaths::GroundContactReport> lay_on_ground(const settings::RunSettings& settings,
    const PlacementGround& ground, const flightpaths::PlacementOptions& placement, LoadedPath& loaded,
    std::vector<std::string>& notes) {
    if (!has_own_origin(settings, loaded, ground) || placement.mode != sim::HeightMode::Datum ||
        settings.path.height_mode || placement.heading_rad != 0.0) {
        return {};
    }
    const GroundHeight below = ground_below(ground, placement.place_m);
    std::vector<flightpaths::GroundContactReport> reports;
    for (std::size_t i = 0; i < loaded.inferences.size() && i <= loaded.others.size(); ++i) {
        sim::Trajectory& track = i == 0 ? loaded.trajectory : loaded.others[i - 1].trajectory;
        const auto heights = loaded.recording->aircraft[i].heights;
        constexpr double usual_reach_m = 1.0;
        const double reach_m = i < ground.reach_below_m.size() ? ground.reach_below_m[i] : usual_reach_m;
        const flightpaths::GroundContactOptions options{.reach_below_m = std::max(0.05, reach_m),
            .by_pressure = heights == flightpaths::HeightKind::Pressure || heights == flightpaths::HeightKind::Unknown,
            .from_s = i == 0 ? placement.from_s : track.start_s(),
            .to_s = i == 0 ? placement.to_s : track.end_s()};
        flightpaths::LaidTrack laid = flightpaths::laid_on_ground(track, loaded.inferences[i], below, options);
        track = std::move(laid.trajectory);
        reports.push_back(std::move(laid.report));
        if (i == 0) { add(notes, laid.notes); }
    }
    return reports;
}

/// Aircraft of an ACMI recording may stand on a ground that lies a little lower than ours: where the path meets our
/// ground, the whole recording is lifted clear, and a note says so.
flightpaths::PlacedPath placed_path(
    const LoadedPath& loaded, flightpaths::PlacementOptions placement, const PlacementGround& ground) {
    const bool is_acmi = loaded.recording && loaded.recording->format == "Tacview ACMI";
    if (!is_acmi || placement.mode != sim::HeightMode::Datum) {
        return flightpaths::place_over_ground(
            loaded.trajectory, placement, ground.height_at, loaded.min_clearance_m, loaded.limits);
    }
    try {
        return flightpaths::place_over_ground(
            loaded.trajectory, placement, ground.height_at, loaded.min_clearance_m, loaded.limits);
    } catch (const flightpaths::OutsideMapError&) { throw; } catch (const Error&) {
    }
    constexpr double min_m = 2.0;
    placement.mode = sim::HeightMode::Clear;
    flightpaths::PlacedPath lifted =
        flightpaths::place_over_ground(loaded.trajectory, placement, ground.height_at, min_m, loaded.limits);
    lifted.notes.push_back(
        fmt::format("the recording's first aircraft meets this ground: all are lifted by {:.1f} m", lifted.offset_m));
    return lifted;
}

/// Places a path over the ground. Errors begin with the name of the path.
flightpaths::PlacedPath placed_by_name(const std::string& name, const LoadedPath& loaded,
    const flightpaths::PlacementOptions& placement, const PlacementGround& ground) {
    try {
        return placed_path(loaded, placement, ground);
    } catch (const flightpaths::OutsideMapError& fault) {
        const bool knows_its_place = loaded.origin && ground.frame;
        throw Error(fmt::format("{}: {}; the map reaches {:.1f} km east and {:.1f} km north of its middle, {}and "
                                "--terrain none has no end",
            printable(name), fault.what(), ground.half_extent_m.x / 1000.0, ground.half_extent_m.y / 1000.0,
            knows_its_place ? "--over-map flies the part over it, " : ""));
    } catch (const Error& fault) { throw Error(fmt::format("{}: {}", printable(name), fault.what())); }
}

/// A path as it is flown from another time on.
sim::Trajectory starting_at_time(const sim::Trajectory& path, double time_s) {
    std::vector<sim::AircraftState> samples(path.samples().begin(), path.samples().end());
    for (sim::AircraftState& state : samples) { state.time_s += time_s - path.start_s(); }
    return sim::Trajectory(std::move(samples));
}

} // namespace

PlacementGround placement_ground(const SceneGround& ground) {
    return {[&ground](double x_m, double y_m) { return ground.ground->height_at(x_m, y_m); },
        ground.ground->half_extent_m(), ground.info.frame};
}

PlacedFlight live_flight(const settings::RunSettings& settings, const PlacementGround& ground) {
    constexpr double above_ground_m = 300.0;
    constexpr double usual_rate_hz = 60.0;
    glm::dvec2 place_m(0.0);
    if (settings.path.place) {
        place_m = path_origin_from_text(*settings.path.place, ground.frame.get(), ground.half_extent_m);
    }
    sim::AircraftState state;
    const double ground_m = ground.height_at(place_m.x, place_m.y).value_or(0.0);
    state.position_m = glm::dvec3(place_m, ground_m + above_ground_m);
    state.body_to_world = body_to_world_from_euler({});
    return {.trajectory = sim::Trajectory({state}),
        .title = fmt::format("live over {}", std::filesystem::path(settings.path.terrain).stem().string()),
        .rate_hz = usual_rate_hz,
        .place_m = place_m,
        .lowest_clearance_m = above_ground_m,
        .legs = {},
        .name = {},
        .other_trajectories = {},
        .other_names = {},
        .recording = {},
        .inferences = {},
        .ground_contacts = {}};
}

PlacedFlight place_flight(const settings::RunSettings& settings, LoadedPath loaded, const PlacementGround& ground,
    std::vector<std::string>& notes, const std::optional<PathPlacement>& given_placement) {
    loaded = in_axes_of(ground, settings, std::move(loaded), notes);
    flightpaths::PlacementOptions placement = placement_of(settings, loaded, ground);
    if (given_placement) {
        placement.place_m = given_placement->place_m;
        placement.heading_rad = given_placement->heading_rad;
    }
    if (has_own_origin(settings, loaded, ground) && placement.mode == sim::HeightMode::Datum) {
        keep_part_over_map(settings, ground, placement.place_m, loaded, notes);
        const FlownPart part = flown_part(settings.time, loaded.trajectory);
        placement.from_s = part.from_s;
        placement.to_s = part.to_s;
        placement.may_leave_map = settings.time.start_s > 0.0 || settings.time.seconds || settings.time.frames;
    } else if (settings.path.over_map) {
        keep_part_over_map(settings, ground, placement.place_m, loaded, notes);
    }
    std::vector<flightpaths::GroundContactReport> contacts = lay_on_ground(settings, ground, placement, loaded, notes);
    flightpaths::PlacedPath path = placed_by_name(path_of(settings), loaded, placement, ground);
    const FlownPart flown = flown_part(settings.time, path.trajectory);
    add(notes, path.notes);
    std::map<std::size_t, sim::Trajectory> other_trajectories;
    std::map<std::size_t, std::string> other_names;
    for (std::size_t i = 0; i < loaded.others.size(); ++i) {
        other_trajectories.emplace(i + 1, flightpaths::with_same_placement(loaded.others[i].trajectory, path));
        other_names.emplace(i + 1, loaded.others[i].name);
    }
    const auto stem = [](const std::string& name) { return std::filesystem::path(name).stem().string(); };
    return {.trajectory = std::move(path.trajectory),
        .title = fmt::format("{} {} over {}", stem(settings::aircraft_shape(settings.path.aircraft.front())),
            stem(path_of(settings)), stem(settings.path.terrain)),
        .rate_hz = loaded.rate_hz,
        .place_m = path.origin_m,
        .heading_rad = path.heading_rad,
        .offset_m = path.offset_m,
        .lowest_clearance_m = path.lowest_clearance_m,
        .lowest_clearance_s = path.lowest_clearance_at_s,
        .flown_from_s = flown.from_s,
        .flown_to_s = flown.to_s,
        .legs = std::move(loaded.legs),
        .name = std::move(loaded.name),
        .other_trajectories = std::move(other_trajectories),
        .other_names = std::move(other_names),
        .recording = std::move(loaded.recording),
        .inferences = std::move(loaded.inferences),
        .ground_contacts = std::move(contacts)};
}

sim::Trajectory own_path(const settings::RunSettings& settings, const settings::AircraftEntry& flown,
    const glm::dvec2& begin_m, const PlacementGround& ground, const PlacedFlight& first,
    std::vector<std::string>& notes) {
    LoadedPath loaded = in_axes_of(ground, settings, load_path(*flown.path, flown.shape, settings.path.lenient), notes);
    add(notes, loaded.notes);
    flightpaths::PlacementOptions placement = placement_of(settings, loaded, ground);
    if (!has_own_origin(settings, loaded, ground)) {
        placement.heading_rad = first.heading_rad;
        const glm::dvec3 start_m = loaded.trajectory.samples().front().position_m;
        const glm::dquat turn = glm::angleAxis(-first.heading_rad, glm::dvec3(0.0, 0.0, 1.0));
        placement.place_m = begin_m - glm::dvec2(turn * start_m);
    }
    lay_on_ground(settings, ground, placement, loaded, notes);
    flightpaths::PlacedPath path = placed_by_name(*flown.path, loaded, placement, ground);
    add(notes, path.notes);
    return starting_at_time(path.trajectory, first.trajectory.start_s() + flown.from_s);
}

namespace heights = models::heights;

namespace {

PlacementGround placement_ground(const heights::HeightField& field) {
    return {[&field](double x_m, double y_m) { return field.height_at(x_m, y_m); }, field.half_extent_m(),
        heights::frame_of_ground(field.system, field.place)};
}

/// Below the beginning of a path, along the way its aircraft looks there, or near the first 15 km.
heights::RunwayRequest runway_request_of(const sim::Trajectory& path, double water_m) {
    constexpr double step_m = 500.0;
    constexpr std::size_t max_places = 31;
    const sim::AircraftState& first = path.samples().front();
    const glm::dvec3 ahead = first.body_to_world * glm::dvec3(1.0, 0.0, 0.0);
    heights::RunwayRequest request;
    request.path_m.emplace_back(first.position_m);
    for (const sim::AircraftState& state : path.samples()) {
        const glm::dvec2 place_m(state.position_m);
        if (request.path_m.size() < max_places && glm::distance(request.path_m.back(), place_m) >= step_m) {
            request.path_m.push_back(place_m);
        }
    }
    request.heading_rad = std::atan2(ahead.x, ahead.y);
    request.water_m = water_m;
    return request;
}

/// Throws Error for a site that is none, or too rough.
void check_site(const std::optional<heights::RunwaySite>& site) {
    const std::string expected =
        fmt::format("--show airfield: expected ground within {:.0f} km of the path on which a runway of 1,800 m "
                    "needs cuttings and embankments of at most {:.0f} m",
            heights::runway_search_radius_m / 1000.0, heights::max_earthwork_m);
    if (!site) { throw Error(fmt::format("{}, got only water or the edge of the map", expected)); }
    if (site->earthwork_m > heights::max_earthwork_m) {
        throw Error(fmt::format("{}, got {:.0f} m at best; another --place may do", expected, site->earthwork_m));
    }
}

std::string note_of(const heights::RunwaySite& site, const heights::RunwayRequest& request) {
    const std::array<std::string, 2> numbers = visuals::nature::runway_numbers(site.strip.heading_rad);
    std::string where = "where the path begins";
    if (!site.matches_request) {
        const glm::dvec2 way_m = site.strip.place({0.5 * site.strip.length_m, 0.0}) - request.path_m.front();
        const double bearing_deg = deg_from_rad(std::atan2(way_m.x, way_m.y));
        where = fmt::format("{:.1f} km from where the path begins, at {:03.0f} degrees, as rough ground, water "
                            "or the map's edge is in its way there",
            glm::length(way_m) / 1000.0, bearing_deg < 0.0 ? bearing_deg + 360.0 : bearing_deg);
    }
    return fmt::format("airfield: runway {}/{} lies {}; its cuttings and embankments are up to {:.0f} m high",
        numbers[0], numbers[1], where, site.earthwork_m);
}

} // namespace

RunwayFinder make_runway_finder(const settings::RunSettings& settings, const std::optional<LoadedPath>& script,
    std::optional<PathPlacement>& given_placement) {
    if (!settings.ground.airfield) { return nullptr; }
    return [&](const heights::HeightField& field, std::vector<std::string>& notes) {
        std::vector<std::string> unused; // placing the path on the levelled ground gives the same notes again
        const PlacementGround ground = placement_ground(field);
        const PlacedFlight first =
            script ? place_flight(settings, *script, ground, unused) : live_flight(settings, ground);
        given_placement = {first.place_m, first.heading_rad};
        const bool has_water = ellipsoid_below(field.place).is_earth();
        const heights::RunwayRequest request = runway_request_of(
            first.trajectory, has_water ? settings.air.water_level_m : -std::numeric_limits<double>::infinity());
        const auto site = heights::runway_site(field, request);
        check_site(site);
        notes.push_back(note_of(*site, request));
        return site->strip;
    };
}

RunwayFinder fixed_runway_finder(std::shared_ptr<const heights::RunwayStrip> runway) {
    if (!runway) { return nullptr; }
    return [runway = std::move(runway)](const heights::HeightField&, std::vector<std::string>&) { return *runway; };
}

} // namespace octant::ui::world
