#include "visuals/scene/camera_rig.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::scene {

namespace {

constexpr double default_fov_deg = 45.0;
constexpr double chase_lag_s = 0.45;
constexpr double chase_distance_radii = 3.0;
/// The share of the distance by which the eye stands higher.
constexpr double chase_rise = 0.27;
constexpr double orbit_distance_radii = 3.4;
constexpr double orbit_turn_s = 16.0;
constexpr double orbit_swing_s = 22.0;
constexpr double orbit_swing_rad = rad_from_deg(55.0);
/// The steepest that an eye or a look is turned.
constexpr double steepest_rad = rad_from_deg(89.0);
/// The widest field of view.
constexpr double widest_rad = rad_from_deg(160.0);

/// How far a view is turned and how near it is; 0, 0, 1 = the view itself.
struct Turn {
    /// Clockwise seen from above.
    double azimuth_rad = 0.0;
    double elevation_rad = 0.0;
    double zoom = 1.0;
};

Turn turn_of(const ViewSettings& settings) {
    return {rad_from_deg(settings.azimuth_deg), rad_from_deg(settings.elevation_deg), settings.zoom};
}

bool is_turned(const Turn& turn) { return turn.azimuth_rad != 0.0 || turn.elevation_rad != 0.0; }

double elevation_of(const glm::dvec3& direction) {
    return std::asin(std::clamp(direction.z / glm::length(direction), -1.0, 1.0));
}

/// The part of a wanted change of elevation that does not pass straight up or down.
double change_of_elevation(double elevation_rad, double wanted_rad) {
    const double steepest = std::max(steepest_rad, std::abs(elevation_rad));
    return std::clamp(elevation_rad + wanted_rad, -steepest, steepest) - elevation_rad;
}

double nearer_m(double distance_m, double zoom, const Subject& subject) {
    return std::max(distance_m / zoom, std::min(distance_m, subject.radius_m));
}

/// Rotation of the world that takes an eye, `from_aircraft` off, around the aircraft.
glm::dquat around_aircraft(const glm::dvec3& from_aircraft, const Turn& turn) {
    const glm::dvec3 up(0.0, 0.0, 1.0);
    const glm::dquat sideways = glm::angleAxis(-turn.azimuth_rad, up);
    const glm::dvec3 outward = sideways * from_aircraft;
    const glm::dvec3 horizontal_right = glm::cross(outward, up);
    const double size = glm::length(horizontal_right);
    if (size < 1e-9) { return sideways; }
    const double rise_rad = change_of_elevation(elevation_of(outward), turn.elevation_rad);
    return glm::angleAxis(rise_rad, horizontal_right / size) * sideways;
}

Camera chase(const sim::AircraftState& state, const RigState& memory, const Subject& subject, const Turn& turn,
    const GroundHeight& ground) {
    const double default_distance_m = chase_distance_radii * subject.radius_m;
    const double distance_m = nearer_m(default_distance_m, turn.zoom, subject);
    glm::dvec3 eye_m = state.position_m - distance_m * memory.lagging_forward;
    eye_m.z += chase_rise * distance_m;
    glm::dvec3 target_m =
        state.position_m + 0.5 * subject.radius_m * (distance_m / default_distance_m) * memory.lagging_forward;
    if (is_turned(turn)) {
        const glm::dquat around = around_aircraft(eye_m - state.position_m, turn);
        eye_m = state.position_m + around * (eye_m - state.position_m);
        target_m = state.position_m + around * (target_m - state.position_m);
    }
    lift_above_ground(eye_m, ground);
    return camera_looking_at(eye_m, target_m);
}

Camera cockpit(const sim::AircraftState& state, const Subject& subject, const GroundHeight& ground) {
    Camera camera;
    camera.eye_m = state.position_m + state.body_to_world * subject.pilot_eye_m;
    lift_above_ground(camera.eye_m, ground);
    camera.view_to_world = glm::normalize(state.body_to_world * body_from_view());
    camera.near_m = 0.15;
    return camera;
}

Camera orbit(const sim::AircraftState& state, const Subject& subject, const Turn& turn, const GroundHeight& ground) {
    const double azimuth_rad = 2.0 * pi * state.time_s / orbit_turn_s + turn.azimuth_rad;
    const double swing_rad = orbit_swing_rad * std::sin(2.0 * pi * state.time_s / orbit_swing_s);
    const double elevation_rad = std::clamp(swing_rad + turn.elevation_rad, -steepest_rad, steepest_rad);
    const double distance_m = nearer_m(orbit_distance_radii * subject.radius_m, turn.zoom, subject);
    const glm::dvec3 level = direction_from_heading(azimuth_rad);
    const glm::dvec3 outward = std::cos(elevation_rad) * level + glm::dvec3(0.0, 0.0, std::sin(elevation_rad));
    glm::dvec3 eye_m = state.position_m + distance_m * outward;
    lift_above_ground(eye_m, ground);
    return camera_looking_at(eye_m, state.position_m);
}

/// In the cockpit about the aircraft's own axes, elsewhere about the vertical.
void turn_look(Camera& camera, View view, const Turn& turn) {
    if (is_turned(turn)) {
        const glm::dvec3 right(1, 0, 0);
        if (view == View::Cockpit) {
            camera.view_to_world = camera.view_to_world * glm::angleAxis(-turn.azimuth_rad, glm::dvec3(0, 1, 0)) *
                                   glm::angleAxis(turn.elevation_rad, right);
        } else {
            const glm::dvec3 ahead = camera.view_to_world * glm::dvec3(0, 0, -1);
            const double rise_rad = change_of_elevation(elevation_of(ahead), turn.elevation_rad);
            camera.view_to_world = glm::angleAxis(-turn.azimuth_rad, glm::dvec3(0, 0, 1)) * camera.view_to_world *
                                   glm::angleAxis(rise_rad, right);
        }
        camera.view_to_world = glm::normalize(camera.view_to_world);
    }
    if (turn.zoom != 1.0) {
        camera.vertical_fov_rad =
            std::min(2.0 * std::atan(std::tan(0.5 * camera.vertical_fov_rad) / turn.zoom), widest_rad);
    }
}

} // namespace

RigState next_rig_state(const RigState& memory, const sim::AircraftState& state) {
    static const double share = 1.0 - std::exp(-sim::step_s / chase_lag_s);
    const glm::dvec3 forward = state.body_to_world * glm::dvec3(1, 0, 0);
    if (memory.lagging_forward == glm::dvec3(0.0)) { return {forward}; }
    const glm::dvec3 mixed = glm::mix(memory.lagging_forward, forward, share);
    const double length = glm::length(mixed);
    return {length > 1e-9 ? mixed / length : forward};
}

Camera camera_of(const ViewSettings& settings, const sim::AircraftState& state, const RigState& memory,
    const Subject& subject, const FixedViewpoints& points, const GroundHeight& ground) {
    const Turn turn = turn_of(settings);
    const auto with_fov = [&](Camera camera) {
        camera.vertical_fov_rad = rad_from_deg(settings.fov_deg.value_or(default_fov_deg));
        return camera;
    };
    const auto lifted = [&](glm::dvec3 eye_m) {
        lift_above_ground(eye_m, ground);
        return eye_m;
    };
    const auto turned = [&](Camera camera) {
        turn_look(camera, settings.kind, turn);
        return camera;
    };
    switch (settings.kind) {
    case View::Chase:
        return with_fov(chase(state, memory, subject, turn, ground));
    case View::Cockpit:
        return turned(with_fov(cockpit(state, subject, ground)));
    case View::Tower: {
        const glm::dvec3 eye_m = lifted(points.tower.eye_m);
        Camera camera = settings.fov_deg ? with_fov(camera_looking_at(eye_m, state.position_m))
                                         : tower_camera(points.tower, state.position_m, subject.radius_m);
        camera.eye_m = eye_m;
        return turned(camera);
    }
    case View::Orbit:
        return with_fov(orbit(state, subject, turn, ground));
    case View::Free:
        break;
    }
    return turned(with_fov(camera_looking_at(lifted(points.free_eye_m), points.free_look_m)));
}

} // namespace octant::visuals::scene
