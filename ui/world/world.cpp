#include "ui/world/world.h"

#include "flightpaths/path_script.h"
#include "flightpaths/placement.h"
#include "flightpaths/recorded_track.h"
#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "ui/base/data_files.h"
#include "ui/settings/settings_check.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/place_text.h"
#include "ui/world/scene_ground.h"
#include "ui/world/sun_of_time.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <future>
#include <utility>

namespace octant::ui::world {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

/// Lowest clearance of a recorded track that is lifted over ground: it names none itself.
constexpr double track_clearance_m = 50.0;

/// A path before it is laid over ground.
struct Script {
    sim::Trajectory trajectory;
    double rate_hz = 0.0;
    double min_clearance_m = 0.0;
    std::optional<sim::AircraftLimits> limits;    ///< of what flies, where they are known
    std::optional<flightpaths::GeoOrigin> origin; ///< of a track that knows where it was flown
    std::vector<flightpaths::LegBegin> legs;
    std::vector<std::string> notes;
};

const sim::AircraftKind& flown_kind(const flightpaths::PathScript& script) {
    try {
        return sim::aircraft_kind(script.aircraft);
    } catch (const Error& fault) {
        error_at(script.file, script.aircraft_line, fault.what());
    }
}

/// What a person should be told where an aircraft without a row of its own flies a built-in path.
void note_what_flies(
    const std::string& path,
    const std::string& aircraft,
    const sim::AircraftKind& flown,
    std::vector<std::string>& notes) {
    const bool is_built_in =
        std::ranges::find(base::built_in_paths, path) != base::built_in_paths.end();
    if (is_built_in && sim::find_aircraft_kind(aircraft) == nullptr) {
        notes.push_back(fmt::format(
            "{} flies the {} path of {}, within its limits: only its own shape is known",
            printable(aircraft),
            path,
            flown.name));
    }
}

Script load_script(const settings::RunSettings& settings) {
    const std::filesystem::path file =
        base::path_file(settings.path.name, settings.path.aircraft.front());
    if (file.extension() == ".toml") {
        const flightpaths::PathScript script = flightpaths::read_path_script(file);
        const sim::AircraftKind& kind = flown_kind(script);
        flightpaths::FlownPath flown = flightpaths::fly(script, kind, settings.path.lenient);
        note_what_flies(settings.path.name, settings.path.aircraft.front(), kind, flown.notes);
        return {
            std::move(flown.trajectory),
            static_cast<double>(script.rate_hz),
            script.min_clearance_m,
            kind.limits,
            {},
            std::move(flown.legs),
            std::move(flown.notes)};
    }
    flightpaths::RecordedTrack track = flightpaths::read_recorded_track(file);
    const auto samples = track.trajectory.samples();
    const double mean_step_s =
        (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
    const sim::AircraftKind* kind = sim::find_aircraft_kind(settings.path.aircraft.front());
    return {
        std::move(track.trajectory),
        1.0 / mean_step_s,
        track_clearance_m,
        kind == nullptr ? std::nullopt : std::optional(kind->limits),
        track.origin,
        {},
        {}};
}

flightpaths::HeightMode placement_mode(settings::HeightMode mode) {
    switch (mode) {
    case settings::HeightMode::Clear:
        return flightpaths::HeightMode::Clear;
    case settings::HeightMode::Follow:
        return flightpaths::HeightMode::Follow;
    case settings::HeightMode::Datum:
        break;
    }
    return flightpaths::HeightMode::Datum;
}

flightpaths::Placement placement_of(
    const settings::RunSettings& settings, const Script& script, const SceneGround& ground) {
    flightpaths::Placement placement;
    const glm::dvec2 half_extent_m = ground.ground->half_extent_m();
    const bool at_its_own_place = script.origin && ground.place && !settings.path.place;
    if (settings.path.place) {
        placement.place_m = place_from_text(*settings.path.place, ground.place, half_extent_m);
    } else if (at_its_own_place) {
        placement.place_m = flightpaths::local_from_geo(
            {ground.place->latitude_deg, ground.place->longitude_deg},
            script.origin->latitude_deg,
            script.origin->longitude_deg);
        placement.heading_rad = 0.0;
    }
    if (settings.path.heading_deg) {
        placement.heading_rad = rad_from_deg(*settings.path.heading_deg);
    }
    placement.mode = placement_mode(settings.path.height_mode.value_or(
        at_its_own_place ? settings::HeightMode::Datum : settings::HeightMode::Clear));
    if (placement.mode == flightpaths::HeightMode::Follow && !script.limits) {
        throw Error(fmt::format(
            "--height-mode follow: expected an aircraft with known limits beside a recorded track, "
            "got '{}'",
            printable(settings.path.aircraft.front())));
    }
    return placement;
}

void add(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

Flight place_flight(
    const settings::RunSettings& settings,
    Script script,
    const SceneGround& ground,
    std::vector<std::string>& notes) {
    flightpaths::PlacedPath placed = flightpaths::place_over_ground(
        script.trajectory,
        placement_of(settings, script, ground),
        [&](double x_m, double y_m) { return ground.ground->height_at(x_m, y_m); },
        script.min_clearance_m,
        script.limits);
    add(notes, placed.notes);
    const auto stem = [](const std::string& name) {
        return std::filesystem::path(name).stem().string();
    };
    return {
        .trajectory = std::move(placed.trajectory),
        .title = fmt::format(
            "{} {} over {}",
            stem(settings.path.aircraft.front()),
            stem(settings.path.name),
            stem(settings.path.terrain)),
        .rate_hz = script.rate_hz,
        .place_m = placed.origin_m,
        .heading_rad = placed.heading_rad,
        .offset_m = placed.offset_m,
        .lowest_clearance_m = placed.lowest_clearance_m,
        .lowest_clearance_s = placed.lowest_clearance_at_s,
        .legs = std::move(script.legs)};
}

/// The first aircraft stands where its path would begin until somebody moves it.
Flight live_flight(const settings::RunSettings& settings, const SceneGround& ground) {
    constexpr double above_ground_m = 300.0;
    constexpr double usual_rate_hz = 60.0;
    glm::dvec2 place_m(0.0);
    if (settings.path.place) {
        place_m =
            place_from_text(*settings.path.place, ground.place, ground.ground->half_extent_m());
    }
    sim::AircraftState state;
    const double ground_m = ground.ground->height_at(place_m.x, place_m.y).value_or(0.0);
    state.position_m = glm::dvec3(place_m, ground_m + above_ground_m);
    state.body_to_world = body_to_world_from_euler({});
    return {
        .trajectory = sim::Trajectory({state}),
        .title = fmt::format(
            "live over {}", std::filesystem::path(settings.path.terrain).stem().string()),
        .rate_hz = usual_rate_hz,
        .place_m = place_m,
        .lowest_clearance_m = above_ground_m,
        .legs = {}};
}

/// The leader's path has been laid over the ground; those beside him must clear it too.
void check_wingmen(const World& world) {
    const Formation formation = formation_of(world.scene);
    for (std::size_t number = 1; number < world.scene.aircraft.size(); ++number) {
        std::vector<sim::AircraftState> states;
        for (const sim::AircraftState& leader : world.flight.trajectory.samples()) {
            states.push_back(formation.wingman_of(leader, static_cast<int>(number)));
        }
        try {
            flightpaths::check_over_ground(
                sim::Trajectory(std::move(states)),
                [&](double x_m, double y_m) { return world.scene.ground->height_at(x_m, y_m); });
        } catch (const Error& fault) {
            throw Error(fmt::format(
                "wingman {}: {}; fewer --aircraft, another --place or another --heading may do",
                number,
                fault.what()));
        }
    }
}

} // namespace

Formation formation_of(const planning::Scene& scene) {
    double largest_m = 0.0;
    for (const std::uint32_t model : scene.aircraft) {
        largest_m = std::max(largest_m, scene.models[model]->subject.radius_m);
    }
    return {static_cast<int>(scene.aircraft.size()), largest_m};
}

scene::FixedPoints fixed_points(const settings::RunSettings& settings, const World& world) {
    settings::check_eye_point(settings.view);
    scene::FixedPoints points;
    if (settings.view.kind == scene::View::Free) {
        points.free_eye_m = *settings.view.eye_m;
        points.free_look_m = *settings.view.look_m;
    }
    if (settings.view.kind != scene::View::Tower && settings.view.inset != scene::View::Tower) {
        return points;
    }
    if (settings.view.kind == scene::View::Tower && settings.view.eye_m) {
        points.tower_m = *settings.view.eye_m;
        return points;
    }
    constexpr std::size_t every = 10;
    std::vector<glm::dvec3> flight_m;
    for (std::size_t i = 0; i < world.flight.trajectory.samples().size(); i += every) {
        flight_m.push_back(world.flight.trajectory.samples()[i].position_m);
    }
    points.tower_m =
        scene::tower_place(flight_m, world.flight.place_m, [&](double x_m, double y_m) {
            return world.scene.ground->height_at(x_m, y_m);
        });
    return points;
}

World load_world(const settings::RunSettings& settings, DrawnBy drawn_by) {
    settings::check_settings(settings);
    check_place(settings.path);
    // Beside the aircraft, whose draw order is one thread's work. What is wrong with them is told
    // first.
    std::future<SceneGround> coming_ground =
        std::async(std::launch::async, [&] { return load_scene_ground(settings, drawn_by); });
    LoadedAircraft aircraft = load_aircraft(settings);
    const bool is_live = settings.path.name == settings::live_path;
    std::optional<Script> script = is_live ? std::nullopt : std::optional(load_script(settings));
    SceneGround ground = coming_ground.get();
    World world;
    world.notes = std::move(aircraft.notes);
    world.order_files = std::move(aircraft.order_files);
    if (script) {
        add(world.notes, script->notes);
    }
    add(world.notes, ground.notes);
    world.flight = script ? place_flight(settings, std::move(*script), ground, world.notes)
                          : live_flight(settings, ground);
    world.scene = {
        std::move(ground.ground),
        std::move(ground.texture),
        std::move(aircraft.models),
        std::move(aircraft.aircraft),
        aircraft.cockpit,
        std::move(aircraft.dials)};
    world.leader_kind = sim::find_aircraft_kind(settings.path.aircraft.front());
    world.ground_name = std::move(ground.name);
    world.ground_place = ground.place;
    if (auto night = note_of_night(settings, ground.place)) {
        world.notes.push_back(std::move(*night));
    }
    if (!is_live) {
        check_wingmen(world);
    }
    world.points = fixed_points(settings, world);
    return world;
}

} // namespace octant::ui::world
