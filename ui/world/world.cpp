#include "ui/world/world.h"

#include "flightpaths/limits_check.h"
#include "flightpaths/placement.h"
#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/thread_pool.h"
#include "sim/trajectory.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/settings_check.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/path_placement.h"
#include "ui/world/scene_ground.h"
#include "visuals/planning/aircraft_model.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace octant::ui::world {

using settings::RunSettings;

namespace {

double first_time_s(const RunSettings& settings, const sim::Trajectory& path) {
    const double length_s = path.end_s() - path.start_s();
    if (settings.time.start_s > 0.0 && settings.time.start_s >= length_s) {
        throw Error(
            fmt::format("--start: expected less than the path's {} s, got {}", length_s, settings.time.start_s));
    }
    return path.start_s() + settings.time.start_s;
}

} // namespace

void PictureTimes::truncate_to(std::size_t frames) {
    if (frames < times_s.size()) {
        times_s.resize(frames);
        last_step_s = times_s.back();
    }
}

PictureTimes picture_times_of(const RunSettings& settings, const PlacedFlight& flight) {
    const sim::Trajectory& path = flight.trajectory;
    const double from_s = first_time_s(settings, path);
    PictureTimes times;
    times.rate_hz = settings.time.frame_per_sample ? flight.rate_hz : settings.time.rate_hz;
    times.last_step_s = settings.time.seconds ? std::min(path.end_s(), from_s + *settings.time.seconds) : path.end_s();
    if (settings.time.frame_per_sample) {
        const double half_frame_s = 0.5 / times.rate_hz;
        for (const sim::AircraftState& sample : path.samples()) {
            if (sample.time_s >= from_s && sample.time_s <= times.last_step_s + half_frame_s) {
                times.times_s.push_back(sample.time_s);
            }
        }
    } else {
        const auto count = static_cast<long>(std::floor((times.last_step_s - from_s) * times.rate_hz + 1e-6)) + 1;
        for (long frame = 0; frame < count; ++frame) {
            times.times_s.push_back(from_s + static_cast<double>(frame) / times.rate_hz);
        }
    }
    if (settings.time.frames) { times.truncate_to(static_cast<std::size_t>(*settings.time.frames)); }
    return times;
}

namespace planning = visuals::planning;

namespace {

constexpr int max_abreast = 9;

int aircraft_abreast(int aircraft) {
    return aircraft <= max_abreast ? aircraft
                                   : static_cast<int>(std::ceil(std::cbrt(static_cast<double>(aircraft)) - 1e-9));
}

} // namespace

Formation::Formation(int aircraft, double largest_radius_m)
    : abreast_(aircraft_abreast(aircraft)), lines_per_layer_(aircraft <= max_abreast ? 1 : abreast_),
      wingmen_per_side_(abreast_ / 2), lateral_spacing_m_(1.7 * largest_radius_m),
      trail_spacing_m_(0.5 * largest_radius_m) {}

sim::AircraftState Formation::wingman_state(const sim::AircraftState& leader, int number) const {
    const int place = number % abreast_;
    const int line = number / abreast_ % lines_per_layer_;
    const int layer = number / abreast_ / lines_per_layer_;
    const double rank = (place + 1) / 2; // NOLINT(bugprone-integer-division): whole ranks
    const double side = place % 2 == 1 ? 1.0 : -1.0;
    const double heading_rad = euler_from_body_to_world(leader.body_to_world).heading_rad;
    const glm::dvec3 ahead = direction_from_heading(heading_rad);
    const glm::dvec3 right(ahead.y, -ahead.x, 0.0);
    sim::AircraftState state = leader;
    state.position_m += rank * (side * lateral_spacing_m_ * right - trail_spacing_m_ * ahead);
    state.position_m += glm::dvec3(0.0, 0.0, line * lateral_spacing_m_) - layer * 2.0 * lateral_spacing_m_ * ahead;
    return state;
}

double Formation::framed_radius_m(double leader_radius_m) const {
    // The camera stands three radii behind and sees a little more than a third of a right angle to either side.
    constexpr double distances_per_aside = 2.2;
    const double distance_m = wingmen_per_side_ * (distances_per_aside * lateral_spacing_m_ + trail_spacing_m_);
    return std::max(leader_radius_m, distance_m / 3.0);
}

double largest_radius_m(const planning::Scene& scene) {
    double largest_m = 0.0;
    for (const std::uint32_t model : scene.aircraft) {
        largest_m = std::max(largest_m, scene.models[model]->subject.radius_m);
    }
    return largest_m;
}

Formation formation_of(const planning::Scene& scene, const PlacedFlight& flight) {
    const std::size_t own = std::min(flight.other_trajectories.size(), scene.aircraft.size() - 1);
    return {static_cast<int>(scene.aircraft.size() - own), largest_radius_m(scene)};
}

void formation_states(const PlacedFlight& flight, const Formation& formation, const sim::AircraftState& leader,
    double time_s, std::span<sim::AircraftState> states) {
    states.front() = leader;
    int number = 0;
    for (std::size_t i = 1; i < states.size(); ++i) {
        const auto own = flight.other_trajectories.find(i);
        if (own == flight.other_trajectories.end()) {
            states[i] = formation.wingman_state(leader, ++number);
            continue;
        }
        const sim::Trajectory& path = own->second;
        states[i] = path.state_at(time_s);
        states[i].time_s = leader.time_s;
        states[i].is_present = time_s >= path.start_s() && time_s <= path.end_s();
    }
}

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

/// The ground for placing the paths of the aircraft of a scene.
PlacementGround placement_ground(const SceneGround& ground, const planning::Scene& scene) {
    PlacementGround below = placement_ground(ground);
    for (std::size_t i = 0; i < scene.aircraft.size(); ++i) {
        below.reach_below_m.push_back(planning::reach_below_m(scene.model_of(i)));
    }
    return below;
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
            const bool is_flown =
                leader.time_s >= world.flight.flown_from_s && leader.time_s <= world.flight.flown_to_s;
            // The rest of a recorded track may leave the map.
            if (is_flown || world.flight.recording == nullptr) {
                states.push_back(formation.wingman_state(leader, number));
            }
        }
        if (states.empty()) { continue; }
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
    std::vector<std::string> messages;
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
            const auto name = world.flight.other_names.find(i);
            messages.push_back(fmt::format("{}{}{} is flown beyond its limits: {}",
                name == world.flight.other_names.end() ? "" : printable(name->second) + ", a ", kind->name,
                in_formation ? " in formation" : "", beyond));
        }
    }
    constexpr std::size_t most = 8;
    if (messages.size() > most) {
        const std::size_t more = messages.size() - most;
        messages.resize(most);
        messages.push_back(fmt::format("{} more aircraft are flown beyond their limits", more));
    }
    add_notes(world.notes, messages);
}

/// The shapes of all aircraft of a run: those of the settings, then those of its recordings, whose first aircraft is
/// the first of the settings.
std::vector<std::string> shapes_of(const settings::RunSettings& settings, std::span<const OtherAircraft> of_recording) {
    std::vector<std::string> shapes;
    for (const std::string& aircraft : settings.path.aircraft) { shapes.push_back(settings::aircraft_shape(aircraft)); }
    if (shapes.empty()) { return shapes; }
    for (std::size_t i = shapes.size(); i <= of_recording.size(); ++i) { shapes.push_back(of_recording[i - 1].shape); }
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
    const bool is_recorded = world.flight.recording != nullptr; // what is not flown may leave the map
    const double from_s = is_recorded ? world.flight.flown_from_s : path.start_s();
    const double to_s = is_recorded ? world.flight.flown_to_s : path.end_s();
    for (int i = 0; i <= looks; ++i) {
        states.push_back(path.state_at(glm::mix(from_s, to_s, static_cast<double>(i) / looks)));
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
    if (!is_live) { path = load_paths(settings); }
    const AircraftSources inputs = aircraft_sources(settings,
        shapes_of(settings, path ? std::span<const OtherAircraft>(path->others) : std::span<const OtherAircraft>()));
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
    world.flight = path ? place_flight(settings, std::move(*path), placement_ground(ground, world.scene), world.notes,
                              loaded.placement)
                        : live_flight(settings, placement_ground(ground));
    if (!is_live) {
        world.scene.path = drawn_path(world.flight);
        add_own_paths(settings, ground, world);
        check_wingmen(world);
        note_limits(inputs.shapes, world);
    }
    world.leader_kind = inputs.shapes.empty() ? nullptr : sim::find_aircraft_kind(inputs.shapes.front());
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
