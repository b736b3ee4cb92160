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

/// Where the tower's camera stands, and what it knows of the land around it.
struct Tower {
    glm::dvec3 eye_m{0.0};
    /// Elevation of the skyline at even steps of heading from north; empty: level all around.
    std::vector<float> skyline_rad;
    /// A narrower field of view would show single samples of the ground.
    double min_fov_rad = min_lens_fov_rad;
};

/// Elevation of the skyline at a heading, radians.
double skyline_rad(const Tower& tower, double heading_rad);

/// The tower's camera: near enough to know an aircraft of this radius, wider where that brings the skyline into the
/// picture beside it, tilted towards the skyline by half the way.
Camera tower_camera(const Tower& tower, const glm::dvec3& aircraft_m, double radius_m);

/// What a place for the tower is chosen by.
struct TowerRequest {
    /// States of the flight at even times.
    std::span<const sim::AircraftState> flight;
    /// The radius of the sphere around the aircraft.
    double radius_m = 10.0;
    /// The spacing of the ground's samples; 0 = as fine as one likes.
    double spacing_m = 0.0;
    /// Where the tower stands if nothing is known of the flight.
    glm::dvec2 fallback_m{0.0};
};

/// A tower at an eye point, lifted out of the ground, for flights as in the wish.
Tower tower_at(glm::dvec3 eye_m, const TowerRequest& request, const GroundHeight& ground);

/// The tower on the ground from which the flight is seen best, as tower_score() has it; `fallback_m` where there is no
/// ground beside the flight. The same wish gives the same tower. Loading work.
Tower tower_for(const TowerRequest& request, const GroundHeight& ground);

/// How well a flight is seen from an eye point, 0..1: the mean over its times of how large the aircraft is, how near to
/// the middle of the picture the skyline runs, so that relief and sky are seen, and how many samples of the ground
/// behind it the picture spans. Times at which ground hides the aircraft, or no operator could follow it, count
/// nothing, and the more of them there are the less the others count.
double tower_score(const glm::dvec3& eye_m, const TowerRequest& request, const GroundHeight& ground);

} // namespace octant::visuals::scene
