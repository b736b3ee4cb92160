#include "ui/world/world.h"

#include "flightpaths/limits_check.h"
#include "flightpaths/placement.h"
#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/thread_pool.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/settings_check.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/formation.h"
#include "ui/world/path_placement.h"
#include "ui/world/runway_finder.h"
#include "ui/world/scene_ground.h"
#include "ui/world/sun_at_time.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

void add_own_paths(const settings::RunSettings& settings, const SceneGround& ground, World& world) {
    const sim::AircraftState start = world.flight.trajectory.samples().front();
    const std::vector<std::string>& aircraft = settings.path.aircraft;
    const Formation abreast(static_cast<int>(aircraft.size()), largest_radius_m(world.scene));
    for (std::size_t i = 1; i < aircraft.size(); ++i) {
        const settings::AircraftEntry flown = settings::parse_aircraft_entry(aircraft[i]);
        if (!flown.path) { continue; }
        const glm::dvec2 begin_m(abreast.wingman_state(start, static_cast<int>(i)).position_m);
        try {
            world.flight.other_trajectories.insert_or_assign(
                i, own_path(settings, flown, begin_m, placement_ground(ground), world.flight, world.notes));
        } catch (const Error& fault) { throw Error(fmt::format("{}: {}", printable(aircraft[i]), fault.what())); }
    }
}

/// The leader's path has been laid over the ground; those beside him must clear it too.
void check_wingmen(const World& world) {
    const Formation formation = formation_of(world.scene, world.flight);
    int number = 0;
    for (std::size_t i = 1; i < world.scene.aircraft.size(); ++i) {
        if (world.flight.other_trajectories.contains(i)) { continue; }
        ++number;
        std::vector<sim::AircraftState> states;
        for (const sim::AircraftState& leader : world.flight.trajectory.samples()) {
            states.push_back(formation.wingman_state(leader, number));
        }
        try {
            flightpaths::check_over_ground(sim::Trajectory(std::move(states)),
                [&](double x_m, double y_m) { return world.scene.ground->height_at(x_m, y_m); });
        } catch (const Error& fault) {
            throw Error(fmt::format(
                "wingman {}: {}; fewer --aircraft, another --place or another --heading may do", number, fault.what()));
        }
    }
}

/// Notes aircraft of known types that fly beyond the limits of their types: in formation they copy the motion of
/// another one, or their path was recorded from another.
void note_limits(const std::vector<std::string>& shapes, World& world) {
    const bool has_script = !world.flight.legs.empty();
    std::vector<std::string> in_formation_before;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const sim::AircraftKind* const kind = sim::find_aircraft_kind(shapes[i]);
        const auto own = world.flight.other_trajectories.find(i);
        const bool in_formation = i > 0 && own == world.flight.other_trajectories.end();
        if (kind == nullptr ||
            (in_formation && std::ranges::find(in_formation_before, shapes[i]) != in_formation_before.end())) {
            continue;
        }
        if (in_formation) { in_formation_before.push_back(shapes[i]); }
        const std::string beyond = flightpaths::limits_violation(kind->limits,
            own == world.flight.other_trajectories.end() ? world.flight.trajectory : own->second,
            in_formation && has_script);
        if (!beyond.empty()) {
            world.notes.push_back(fmt::format(
                "{}{} is flown beyond its limits: {}", kind->name, in_formation ? " in formation" : "", beyond));
        }
    }
}

/// The shapes of all aircraft of a run: those of the settings, then those of its ACMI recording, whose first aircraft
/// is the first of the settings.
std::vector<std::string> shapes_of(
    const settings::RunSettings& settings, const std::vector<std::string>& of_recording) {
    std::vector<std::string> shapes;
    for (const std::string& aircraft : settings.path.aircraft) { shapes.push_back(settings::aircraft_shape(aircraft)); }
    for (std::size_t i = shapes.size() - 1; i < of_recording.size(); ++i) { shapes.push_back(of_recording[i]); }
    return shapes;
}

/// Throws Error where an aircraft of a live flight has a path of its own, or where the first aircraft begins later than
/// at 0 s.
void check_own_paths(const settings::RunSettings& settings, bool is_live) {
    for (std::size_t i = 0; i < settings.path.aircraft.size(); ++i) {
        const settings::AircraftEntry flown = settings::parse_aircraft_entry(settings.path.aircraft[i]);
        if (flown.path && (is_live || (i == 0 && flown.from_s > 0.0))) {
            throw Error(fmt::format("aircraft: expected {}, got '{}'",
                is_live ? "no path for one that others fly" : "the first one to begin at 0 s",
                printable(settings.path.aircraft[i])));
        }
    }
}

std::shared_ptr<const planning::DrawnPath> drawn_path(const PlacedFlight& flight) {
    std::vector<planning::NamedTime> legs;
    for (const flightpaths::LegStart& leg : flight.legs) { legs.push_back({leg.time_s, leg.label}); }
    return std::make_shared<const planning::DrawnPath>(planning::drawn_path(flight.trajectory, legs));
}

/// What decides where the tower stands. `states` receives the flown states; the result refers to them.
scene::TowerRequest tower_request(const World& world, std::vector<sim::AircraftState>& states) {
    constexpr int looks = 160;
    const sim::Trajectory& path = world.flight.trajectory;
    for (int i = 0; i <= looks; ++i) {
        states.push_back(path.state_at(glm::mix(path.start_s(), path.end_s(), static_cast<double>(i) / looks)));
    }
    const double radius_m = world.scene.model_of(0).subject.radius_m;
    return {states, formation_of(world.scene, world.flight).framed_radius_m(radius_m), world.scene.ground->spacing_m(),
        world.flight.place_m};
}

/// A ground, and where the first aircraft's path was laid on it before it was levelled for a runway.
struct GroundAndPlacement {
    SceneGround ground;
    std::optional<PathPlacement> placement;
};

/// Takes the ground of another world where that has the heights of these settings, or loads one. `path`: nothing where
/// others fly the aircraft.
GroundAndPlacement shared_or_load_ground(const World* shared_world, const settings::RunSettings& settings,
    RenderDevice device, const std::optional<LoadedPath>& path) {
    GroundAndPlacement loaded;
    // Levelled heights are those of one flight.
    if (shared_world != nullptr && !settings.ground.airfield && !shared_world->scene.ground->runway()) {
        if (auto shared = shared_scene_ground(shared_world->ground, shared_world->scene.ground, settings, device)) {
            loaded.ground = std::move(*shared);
            return loaded;
        }
    }
    loaded.ground = load_scene_ground(settings, device, make_runway_finder(settings, path, loaded.placement));
    return loaded;
}

void fill_scene(const SceneGround& ground, const LoadedAircraft& aircraft, planning::Scene& scene) {
    scene.ground = ground.ground;
    scene.ground_texture = ground.texture;
    scene.models = aircraft.models;
    scene.aircraft = aircraft.aircraft;
    scene.far_models = aircraft.far_models;
    scene.cockpit = aircraft.cockpit;
    scene.dials = aircraft.dials;
}

/// Notes of views that show less than a person expects.
void note_views(const settings::RunSettings& settings, bool is_live, World& world) {
    if (settings.view.kind == scene::View::Free) {
        const glm::dvec3& eye_m = world.points.free_eye_m;
        if (auto low = low_eye_note(eye_m, world.scene.ground->height_at(eye_m.x, eye_m.y))) {
            world.notes.push_back(std::move(*low));
        }
    }
    const bool from_tower = settings.view.kind == scene::View::Tower || settings.view.inset == scene::View::Tower;
    if (is_live && from_tower && !settings.view.eye_m) {
        world.notes.emplace_back("tower: nothing is known of the flight yet, so it stands beside the place where the "
                                 "aircraft begins; --eye X,Y,Z puts it elsewhere");
    }
}

} // namespace

scene::FixedViewpoints fixed_points(const settings::RunSettings& settings, const World& world) {
    settings::check_eye_point(settings.view);
    scene::FixedViewpoints points;
    if (settings.view.kind == scene::View::Free) {
        points.free_eye_m = *settings.view.eye_m;
        points.free_look_m = *settings.view.look_m;
    }
    if (settings.view.kind != scene::View::Tower && settings.view.inset != scene::View::Tower) { return points; }
    const GroundHeight ground = [&](double x_m, double y_m) { return world.scene.ground->height_at(x_m, y_m); };
    std::vector<sim::AircraftState> states;
    const scene::TowerRequest request = tower_request(world, states);
    const bool placed_by_hand = settings.view.kind == scene::View::Tower && settings.view.eye_m;
    points.tower =
        placed_by_hand ? scene::tower_at(*settings.view.eye_m, request, ground) : scene::tower_for(request, ground);
    return points;
}

void check_clouds(const scene::AirSettings& air, const visuals::landscape::Ground& ground) {
    if (air.clouds <= 0.0 || !air.cloud_height_m) { return; }
    const double highest_m = visuals::landscape::highest_m(ground);
    if (*air.cloud_height_m <= highest_m) {
        throw Error(fmt::format(
            "--cloud-height: expected more than the highest ground, {:.1f} m, got {}", highest_m, *air.cloud_height_m));
    }
}

World load_world(const settings::RunSettings& settings, RenderDevice device, const World* shared_world) {
    settings::check_settings(settings);
    check_path_origin(settings.path);
    const bool is_live = settings.path.name == settings::live_path;
    check_own_paths(settings, is_live);
    // Paths and names of files are read quickly: errors in them are reported at once.
    std::optional<LoadedPath> path;
    if (!is_live) {
        path = load_path(
            path_of(settings), settings::aircraft_shape(settings.path.aircraft.front()), settings.path.lenient);
    }
    const AircraftSources inputs =
        aircraft_sources(settings, shapes_of(settings, path ? path->other_aircraft : std::vector<std::string>()));
    // At the same time, because finding a painting order takes one thread. Errors of the aircraft come first.
    constexpr bool on_two_threads = true;
    auto [aircraft, loaded] = run_both(
        on_two_threads,
        [&] {
            return shared_world != nullptr && shared_world->aircraft.inputs == inputs ? shared_world->aircraft
                                                                                      : load_aircraft(inputs);
        },
        [&] { return shared_or_load_ground(shared_world, settings, device, path); });
    const SceneGround& ground = loaded.ground;
    World world;
    world.aircraft = std::move(aircraft);
    check_clouds(settings.air, *ground.ground);
    fill_scene(ground, world.aircraft, world.scene);
    world.notes = world.aircraft.notes;
    if (path) { add_notes(world.notes, path->notes); }
    add_notes(world.notes, ground.notes);
    world.flight =
        path ? place_flight(settings, std::move(*path), placement_ground(ground), world.notes, loaded.placement)
             : live_flight(settings, placement_ground(ground));
    if (!is_live) {
        world.scene.path = drawn_path(world.flight);
        add_own_paths(settings, ground, world);
        check_wingmen(world);
        note_limits(inputs.shapes, world);
    }
    world.leader_kind = sim::find_aircraft_kind(settings::aircraft_shape(settings.path.aircraft.front()));
    add_notes(world.notes, sun_notes(settings, ground.info.place));
    world.ground = ground.info;
    world.points = fixed_points(settings, world);
    note_views(settings, is_live, world);
    return world;
}

namespace {

/// Why a ground shows neither; empty where it does.
std::string reason_for_no_near_detail(const World& world, const visuals::scene::GroundSettings& settings) {
    if (world.scene.ground->spacing_m() <= 0.0) {
        return fmt::format("{} has no samples between which there could be any", world.ground.name);
    }
    if (visuals::terrain::ground_metric(settings.lod) != visuals::terrain::GroundMetric::ScreenError) {
        return "only ground that is refined by screen-error shows any";
    }
    return {};
}

} // namespace

std::vector<std::string> near_detail_warnings(
    const World& world, const visuals::scene::GroundSettings& settings, std::span<const std::string> given) {
    const std::string why = reason_for_no_near_detail(world, settings);
    const Ellipsoid below = ellipsoid_below(world.ground.place);
    const std::string textured = world.scene.ground_texture ? "where a texture colours the ground there is none"
                                 : !below.is_earth()
                                     ? fmt::format("nothing grows or is built on {}", name_of_body(below))
                                     : "";
    std::vector<std::string> notes;
    const auto note = [&](const std::string& setting, bool is_on, const std::string& reason) {
        if (is_on && !reason.empty() && std::ranges::find(given, "--" + setting) != given.end()) {
            notes.push_back(fmt::format("{} shows nothing: {}", setting, reason));
        }
    };
    note("near-detail", settings.near_detail, why);
    note("scenery", settings.scenery, why.empty() ? textured : why);
    note("roads", settings.roads, why.empty() ? textured : why);
    return notes;
}

} // namespace octant::ui::world
