#include "visuals/scene/camera_rig.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/fixed_step.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace octant::visuals::scene {

namespace {

constexpr double usual_fov_deg = 45.0;
constexpr double least_eye_height_m = 2.0;
constexpr double chase_lag_s = 0.45;
constexpr double chase_distance_radii = 3.0;
constexpr double chase_rise = 0.27; ///< share of the distance by which the eye stands higher
constexpr double orbit_distance_radii = 3.4;
constexpr double orbit_turn_s = 16.0;
constexpr double orbit_swing_s = 22.0;
constexpr double orbit_swing_rad = rad_from_deg(55.0);
constexpr double tower_share = 0.34; ///< of the picture's height that the aircraft's sphere fills
constexpr double tower_least_share = 0.12; ///< the same, where the view widens for the skyline
constexpr double skyline_margin_rad = rad_from_deg(0.6);
constexpr double tower_reach = 0.5; ///< of the flight's extent around its origin
constexpr double tower_least_fov_rad = rad_from_deg(0.7);
constexpr double tower_lowered =
    0.3; ///< of the picture's height that the aircraft may stand above its middle
constexpr double tower_height_m = 25.0;

void lift_above_ground(glm::dvec3& eye_m, const GroundHeight& ground) {
    if (const auto height_m = ground(eye_m.x, eye_m.y)) {
        eye_m.z = std::max(eye_m.z, *height_m + least_eye_height_m);
    }
}

Camera chase(
    const sim::AircraftState& state,
    const RigMemory& memory,
    const Subject& subject,
    const GroundHeight& ground) {
    const double distance_m = chase_distance_radii * subject.radius_m;
    glm::dvec3 eye_m = state.position_m - distance_m * memory.lagging_forward;
    eye_m.z += chase_rise * distance_m;
    lift_above_ground(eye_m, ground);
    return camera_looking_at(
        eye_m, state.position_m + 0.5 * subject.radius_m * memory.lagging_forward);
}

Camera
cockpit(const sim::AircraftState& state, const Subject& subject, const GroundHeight& ground) {
    Camera camera;
    camera.eye_m = state.position_m + state.body_to_world * subject.pilot_eye_m;
    lift_above_ground(camera.eye_m, ground);
    // View axes x right, y up, -z ahead in body axes x forward, y right, z down.
    static const glm::dquat view_to_body =
        glm::quat_cast(glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0)));
    camera.view_to_world = glm::normalize(state.body_to_world * view_to_body);
    camera.near_m = 0.15;
    return camera;
}

double fov_for_share(const Subject& subject, double distance_m, double share) {
    return 2.0 * std::atan(subject.radius_m / share / distance_m);
}

/// Close enough to know the aircraft, which stands in the middle; wider and tilted down where that
/// brings the skyline into the picture below it.
Camera tower(const sim::AircraftState& state, const Subject& subject, const glm::dvec3& eye_m) {
    Camera camera = camera_looking_at(eye_m, state.position_m);
    const glm::dvec3 to_aircraft_m = state.position_m - eye_m;
    const double distance_m = std::max(glm::length(to_aircraft_m), subject.radius_m);
    const double close_rad = fov_for_share(subject, distance_m, tower_share);
    const double wide_rad = fov_for_share(subject, distance_m, tower_least_share);
    const double elevation_rad = std::asin(std::clamp(to_aircraft_m.z / distance_m, -1.0, 1.0));
    const double skyline_below_rad = std::max(elevation_rad, 0.0) + skyline_margin_rad;
    const double wanted_rad = skyline_below_rad / (0.5 + tower_lowered);
    const double reach = 1.0 - glm::smoothstep(1.0, 3.0, wanted_rad / wide_rad);
    camera.vertical_fov_rad = std::max(
        glm::mix(close_rad, std::clamp(wanted_rad, close_rad, wide_rad), reach),
        tower_least_fov_rad);
    const double tilt_rad = std::clamp(
        skyline_below_rad - 0.5 * camera.vertical_fov_rad,
        0.0,
        tower_lowered * camera.vertical_fov_rad);
    const glm::dquat down = glm::angleAxis(-reach * tilt_rad, glm::dvec3(1, 0, 0));
    camera.view_to_world = glm::normalize(camera.view_to_world * down);
    return camera;
}

Camera orbit(const sim::AircraftState& state, const Subject& subject, const GroundHeight& ground) {
    const double azimuth_rad = 2.0 * pi * state.time_s / orbit_turn_s;
    const double elevation_rad =
        orbit_swing_rad * std::sin(2.0 * pi * state.time_s / orbit_swing_s);
    const glm::dvec3 level = direction_from_heading(azimuth_rad);
    const glm::dvec3 outward =
        std::cos(elevation_rad) * level + glm::dvec3(0.0, 0.0, std::sin(elevation_rad));
    glm::dvec3 eye_m = state.position_m + orbit_distance_radii * subject.radius_m * outward;
    lift_above_ground(eye_m, ground);
    return camera_looking_at(eye_m, state.position_m);
}

bool in_sight(const glm::dvec3& eye_m, const glm::dvec3& target_m, const GroundHeight& ground) {
    constexpr double step_m = 30.0;
    const int steps = std::clamp(static_cast<int>(glm::length(target_m - eye_m) / step_m), 2, 400);
    for (int step = 1; step < steps; ++step) {
        const glm::dvec3 point_m = glm::mix(eye_m, target_m, static_cast<double>(step) / steps);
        const auto height_m = ground(point_m.x, point_m.y);
        if (height_m && *height_m > point_m.z) {
            return false;
        }
    }
    return true;
}

} // namespace

RigMemory advanced(const RigMemory& memory, const sim::AircraftState& state) {
    static const double share = 1.0 - std::exp(-sim::step_s / chase_lag_s);
    const glm::dvec3 forward = state.body_to_world * glm::dvec3(1, 0, 0);
    if (memory.lagging_forward == glm::dvec3(0.0)) {
        return {forward};
    }
    const glm::dvec3 mixed = glm::mix(memory.lagging_forward, forward, share);
    const double length = glm::length(mixed);
    return {length > 1e-9 ? mixed / length : forward};
}

Camera camera_of(
    const Settings& settings,
    const sim::AircraftState& state,
    const RigMemory& memory,
    const Subject& subject,
    const FixedPoints& points,
    const GroundHeight& ground) {
    const auto with_fov = [&](Camera camera) {
        camera.vertical_fov_rad = rad_from_deg(settings.fov_deg.value_or(usual_fov_deg));
        return camera;
    };
    const auto lifted = [&](glm::dvec3 eye_m) {
        lift_above_ground(eye_m, ground);
        return eye_m;
    };
    switch (settings.view) {
    case View::Chase:
        return with_fov(chase(state, memory, subject, ground));
    case View::Cockpit:
        return with_fov(cockpit(state, subject, ground));
    case View::Tower:
        return settings.fov_deg
                   ? with_fov(camera_looking_at(lifted(points.tower_m), state.position_m))
                   : tower(state, subject, lifted(points.tower_m));
    case View::Orbit:
        return with_fov(orbit(state, subject, ground));
    case View::Free:
        break;
    }
    return with_fov(camera_looking_at(lifted(points.free_eye_m), points.free_look_m));
}

glm::dvec3 tower_place(
    std::span<const glm::dvec3> flight_m, const glm::dvec2& around_m, const GroundHeight& ground) {
    double extent_m = 0.0;
    for (const glm::dvec3& point_m : flight_m) {
        extent_m = std::max(extent_m, glm::length(glm::dvec2(point_m) - around_m));
    }
    constexpr int rings = 8;
    constexpr int spokes = 16;
    std::vector<std::pair<int, glm::dvec3>> spots; ///< samples in sight, eye point
    for (int ring = 0; ring <= rings; ++ring) {
        for (int spoke = 0; spoke < (ring == 0 ? 1 : spokes); ++spoke) {
            const double distance_m = tower_reach * extent_m * ring / rings;
            const glm::dvec2 spot_m =
                around_m +
                distance_m * glm::dvec2(direction_from_heading(2.0 * pi * spoke / spokes));
            if (const auto height_m = ground(spot_m.x, spot_m.y)) {
                const glm::dvec3 eye_m(spot_m, *height_m + tower_height_m);
                const auto seen = std::count_if(
                    flight_m.begin(), flight_m.end(), [&](const glm::dvec3& target_m) {
                        return in_sight(eye_m, target_m, ground);
                    });
                spots.emplace_back(static_cast<int>(seen), eye_m);
            }
        }
    }
    if (spots.empty()) {
        return {around_m, tower_height_m};
    }
    const int most = std::max_element(spots.begin(), spots.end(), [](const auto& a, const auto& b) {
                         return a.first < b.first;
                     })->first;
    const double enough = most - 0.05 * static_cast<double>(flight_m.size());
    glm::dvec3 best_m(0.0, 0.0, std::numeric_limits<double>::lowest());
    for (const auto& [seen, eye_m] : spots) {
        if (seen >= enough && eye_m.z > best_m.z) {
            best_m = eye_m;
        }
    }
    return best_m;
}

} // namespace octant::visuals::scene
