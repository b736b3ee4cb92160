#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "visuals/scene/camera_rig.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace octant;
using namespace octant::visuals::scene;

namespace {

const GroundHeight flat_ground = [](double, double) { return std::optional<double>(0.0); };
const Subject fighter{10.0, {5.4, 0.0, -1.0}};
const Tower tower{{100.0, 0.0, 20.0}, {}, 0.01};

sim::AircraftState level_flight(double heading_rad) {
    sim::AircraftState state;
    state.position_m = {0.0, 0.0, 500.0};
    state.body_to_world = body_to_world_from_euler({heading_rad, 0.0, 0.0});
    state.velocity_mps = 200.0 * direction_from_heading(heading_rad);
    return state;
}

Camera seen(View view, const sim::AircraftState& state, const GroundHeight& ground = flat_ground) {
    ViewSettings settings;
    settings.kind = view;
    return camera_of(settings, state, next_rig_state({}, state), fighter, {tower, {}, {}}, ground);
}

Camera turned(View view, double azimuth_deg, double elevation_deg, double zoom,
    const sim::AircraftState& state = level_flight(0.0), const GroundHeight& ground = flat_ground) {
    ViewSettings settings;
    settings.kind = view;
    settings.azimuth_deg = azimuth_deg;
    settings.elevation_deg = elevation_deg;
    settings.zoom = zoom;
    return camera_of(
        settings, state, next_rig_state({}, state), fighter, {tower, {0.0, 0.0, 50.0}, {0.0, 500.0, 60.0}}, ground);
}

glm::dvec3 looking(const Camera& camera) { return camera.view_to_world * glm::dvec3(0, 0, -1); }

} // namespace

TEST_CASE("the chase camera stands behind and above and looks ahead") {
    const Camera camera = seen(View::Chase, level_flight(0.0));
    CHECK(camera.eye_m.y < -20.0);
    CHECK(camera.eye_m.z > 500.0);
    CHECK(std::abs(camera.eye_m.x) < 1e-9);
    CHECK(looking(camera).y > 0.9);
}

TEST_CASE("the chase camera lags behind a turn and catches up") {
    RigState memory = next_rig_state({}, level_flight(0.0));
    memory = next_rig_state(memory, level_flight(1.0));
    const glm::dvec3 ahead = direction_from_heading(1.0);
    CHECK(glm::dot(memory.lagging_forward, ahead) < 0.6);
    for (int step = 0; step < 480; ++step) { memory = next_rig_state(memory, level_flight(1.0)); }
    CHECK(glm::dot(memory.lagging_forward, ahead) > 0.999);
}

TEST_CASE("the pilot's eye moves and rolls with the aircraft") {
    sim::AircraftState state = level_flight(0.0);
    state.body_to_world = body_to_world_from_euler({0.0, 0.0, rad_from_deg(90)});
    const Camera camera = seen(View::Cockpit, state);
    CHECK(camera.eye_m.y == Approx(5.4));
    CHECK(camera.eye_m.x == Approx(1.0)); // one metre above the axis, rolled to the right
    CHECK(camera.eye_m.z == Approx(500.0));
    CHECK((camera.view_to_world * glm::dvec3(0, 1, 0)).x == Approx(1.0));
    CHECK(looking(camera).y == Approx(1.0));
}

TEST_CASE("the tower looks at an aircraft overhead and zooms in on it") {
    const Camera camera = seen(View::Tower, level_flight(0.0));
    const glm::dvec3 to_aircraft = glm::dvec3(0, 0, 500) - camera.eye_m;
    CHECK(glm::dot(glm::normalize(to_aircraft), looking(camera)) == Approx(1.0));
    CHECK(camera.vertical_fov_rad < rad_from_deg(25));
}

TEST_CASE("the tower widens for the skyline below an aircraft that is far and low") {
    sim::AircraftState state = level_flight(0.0);
    state.position_m = {100.0, 3000.0, 95.0};
    const Camera camera = seen(View::Tower, state);
    const double look_rad = std::asin(looking(camera).z);
    const double aircraft_rad = std::asin(glm::normalize(state.position_m - camera.eye_m).z);
    CHECK(look_rad - camera.vertical_fov_rad / 2.0 < 0.0);
    CHECK(aircraft_rad - look_rad > 0.0);
    CHECK(aircraft_rad - look_rad < 0.45 * camera.vertical_fov_rad);
    CHECK(camera.vertical_fov_rad < rad_from_deg(5));
}

TEST_CASE("the orbit sees the aircraft from all eight octants") {
    int seen_octants = 0;
    for (int tick = 0; tick < 88 * 20; ++tick) {
        sim::AircraftState state = level_flight(0.3);
        state.time_s = tick / 20.0;
        const Camera camera = seen(View::Orbit, state);
        const glm::dvec3 in_body = glm::inverse(state.body_to_world) * (camera.eye_m - state.position_m);
        seen_octants |= 1 << ((in_body.x < 0 ? 1 : 0) + (in_body.y < 0 ? 2 : 0) + (in_body.z < 0 ? 4 : 0));
    }
    CHECK(seen_octants == 255);
}

TEST_CASE("the chase eye turns around the aircraft, clockwise from above, and up") {
    const auto eye_at = [](double azimuth_deg, double elevation_deg) {
        const Camera camera = turned(View::Chase, azimuth_deg, elevation_deg, 1.0);
        const glm::dvec3 to_aircraft = glm::normalize(level_flight(0.0).position_m - camera.eye_m);
        CHECK(glm::dot(to_aircraft, looking(camera)) > 0.95);
        return camera.eye_m - level_flight(0.0).position_m;
    };
    const double distance_m = glm::length(eye_at(0.0, 0.0));
    const glm::dvec3 left = eye_at(90.0, 0.0); // behind = south, clockwise to the west
    CHECK(left.x < -0.9 * distance_m);
    CHECK(std::abs(left.y) < 1e-9);
    CHECK(eye_at(180.0, 0.0).y > 0.9 * distance_m);
    CHECK(eye_at(0.0, 40.0).z > 0.7 * distance_m);
    CHECK(eye_at(0.0, -60.0).z < -0.6 * distance_m);
    const glm::dvec3 above = eye_at(0.0, 89.0); // not over the top
    CHECK(above.y < 0.0);
    CHECK(glm::length(above) == Approx(distance_m));
}

TEST_CASE("chase and orbit come nearer by the zoom, down to the aircraft's sphere") {
    for (const View view : {View::Chase, View::Orbit}) {
        const auto distance_m = [&](double zoom) {
            return glm::distance(turned(view, 0.0, 0.0, zoom).eye_m, level_flight(0.0).position_m);
        };
        CHECK(distance_m(2.0) == Approx(distance_m(1.0) / 2.0));
        CHECK(distance_m(0.25) == Approx(4.0 * distance_m(1.0)));
        CHECK(distance_m(100.0) >= fighter.radius_m);
        CHECK(turned(view, 0.0, 0.0, 2.0).vertical_fov_rad == rad_from_deg(45));
    }
}

TEST_CASE("the orbit's eye is turned on from where it is") {
    const Camera camera = turned(View::Orbit, 90.0, 30.0, 1.0);
    const glm::dvec3 outward =
        glm::normalize(camera.eye_m - level_flight(0.0).position_m); // at 0 s it stands north, level
    CHECK(outward.x == Approx(std::cos(rad_from_deg(30))));
    CHECK(outward.z == Approx(0.5));
}

TEST_CASE("the pilot's look turns right and up in the aircraft's own axes") {
    sim::AircraftState state = level_flight(0.0);
    state.body_to_world = body_to_world_from_euler({0.0, 0.0, rad_from_deg(90)});
    CHECK(looking(turned(View::Cockpit, 90.0, 0.0, 1.0, state)).z == Approx(-1.0));
    CHECK(looking(turned(View::Cockpit, 0.0, 60.0, 1.0, state)).x == Approx(std::sqrt(0.75)));
    const glm::dvec3 both = looking(turned(View::Cockpit, 90.0, 30.0, 1.0, level_flight(0.0)));
    CHECK(both.x == Approx(std::sqrt(0.75)));
    CHECK(both.z == Approx(0.5));
}

TEST_CASE("the tower's and the free look turn about the vertical and stay upright") {
    for (const View view : {View::Tower, View::Free}) {
        const Camera straight = turned(view, 0.0, 0.0, 1.0);
        const Camera aside = turned(view, 50.0, -10.0, 1.0);
        CHECK(std::abs((aside.view_to_world * glm::dvec3(1, 0, 0)).z) < 1e-12);
        const auto level = [](const Camera& camera) { return glm::normalize(glm::dvec2(looking(camera))); };
        const glm::dvec2 from = level(straight);
        const glm::dvec2 to = level(aside);
        CHECK(glm::dot(from, to) == Approx(std::cos(rad_from_deg(50))));
        CHECK(from.x * to.y - from.y * to.x < 0.0); // to the right
        CHECK(std::asin(looking(straight).z) - std::asin(looking(aside).z) == Approx(rad_from_deg(10)));
        CHECK(looking(turned(view, 0.0, 89.0, 1.0)).z == Approx(std::sin(rad_from_deg(89))));
    }
}

TEST_CASE("cockpit, tower and free views see things larger by the zoom") {
    for (const View view : {View::Cockpit, View::Tower, View::Free}) {
        const double straight = std::tan(0.5 * turned(view, 0.0, 0.0, 1.0).vertical_fov_rad);
        const double zoomed = std::tan(0.5 * turned(view, 0.0, 0.0, 4.0).vertical_fov_rad);
        CHECK(zoomed == Approx(straight / 4.0));
        CHECK(turned(view, 0.0, 0.0, 0.05).vertical_fov_rad < rad_from_deg(170));
    }
}

TEST_CASE("a view that is not turned is the view itself to the last bit") {
    sim::AircraftState state = level_flight(0.7);
    state.time_s = 3.3;
    const Camera chase = seen(View::Chase, state);
    const double distance_m = 30.0;
    glm::dvec3 eye_m = state.position_m - distance_m * (state.body_to_world * glm::dvec3(1, 0, 0));
    eye_m.z += 0.27 * distance_m;
    CHECK(chase.eye_m == eye_m);
    const Camera full_turn = turned(View::Chase, 360.0, 0.0, 1.0, state);
    CHECK(glm::distance(full_turn.eye_m, eye_m) < 1e-9);
    const glm::dquat view_to_body =
        glm::quat_cast(glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0)));
    CHECK(seen(View::Cockpit, state).view_to_world == glm::normalize(state.body_to_world * view_to_body));
}

TEST_CASE("no view puts the eye into the ground") {
    const GroundHeight hill = [](double, double) { return std::optional<double>(700.0); };
    for (const View view : {View::Chase, View::Cockpit, View::Tower, View::Orbit, View::Free}) {
        CHECK(seen(view, level_flight(0.0), hill).eye_m.z >= 702.0);
        CHECK(turned(view, 30.0, -80.0, 3.0, level_flight(0.0), hill).eye_m.z >= 702.0);
    }
}
