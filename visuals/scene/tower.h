#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "visuals/scene/camera.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::scene {

/// Lifts an eye point that is below the ground or within 2 m of it.
inline void lift_above_ground(glm::dvec3& eye_m, const GroundHeight& ground) {
    constexpr double min_height_m = 2.0;
    if (const auto height_m = ground(eye_m.x, eye_m.y)) { eye_m.z = std::max(eye_m.z, *height_m + min_height_m); }
}

/// The narrowest field of view of the tower's lens.
inline constexpr double min_lens_fov_rad = 0.0122;

/// The position of the tower's camera, and the land around it.
struct Tower {
    glm::dvec3 eye_m{0.0};
    /// Elevation of the skyline at equal steps of heading from north; empty = level all around.
    std::vector<float> skyline_rad;
    /// The narrowest field of view, so that single samples of the ground do not show.
    double min_fov_rad = min_lens_fov_rad;
};

/// Elevation of the skyline at a heading, radians.
double skyline_rad(const Tower& tower, double heading_rad);

/// The tower's camera: its field of view is narrow enough to recognize an aircraft of this radius, but wider if that
/// brings the skyline into the picture, too. It is tilted half of the way towards the skyline.
Camera tower_camera(const Tower& tower, const glm::dvec3& aircraft_m, double radius_m);

/// The flight for which the tower's position is chosen.
struct TowerRequest {
    /// States of the flight at equal intervals.
    std::span<const sim::AircraftState> flight;
    /// The radius of the sphere around the aircraft.
    double radius_m = 10.0;
    /// The spacing of the ground's samples; 0 = continuous.
    double spacing_m = 0.0;
    /// The tower's position if `flight` is empty.
    glm::dvec2 fallback_m{0.0};
};

/// A tower at an eye point, lifted above the ground.
Tower tower_at(glm::dvec3 eye_m, const TowerRequest& request, const GroundHeight& ground);

/// The tower on the ground with the largest tower_score(); at `fallback_m` where there is no ground near the flight.
/// The same request gives the same tower. Loading work.
Tower tower_for(const TowerRequest& request, const GroundHeight& ground);

/// A score, 0 to 1, of the view of a flight from an eye point: the mean over its times of three criteria: the size of
/// the aircraft; the nearness of the skyline to the middle of the picture, so that relief and sky are visible; and the
/// number of ground samples behind the aircraft in the picture. Times at which ground hides the aircraft, or it is too
/// fast to follow, count as 0 and reduce the weight of the others.
double tower_score(const glm::dvec3& eye_m, const TowerRequest& request, const GroundHeight& ground);

} // namespace octant::visuals::scene
