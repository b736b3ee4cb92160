#include "visuals/scene/tower.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

namespace {

/// Shares of the picture's height that the aircraft's sphere fills: as a rule, where the view widens for the skyline,
/// and at the least where the lens must stay wide for the ground.
constexpr double close_share = 0.5;
constexpr double wide_share = 0.14;
constexpr double min_share = 0.18;
constexpr double max_fov_rad = rad_from_deg(55.0);
/// How far from the picture's middle, in heights, the aircraft may stand, and the skyline.
constexpr double aircraft_offset = 0.28;
constexpr double skyline_offset = 0.38;

double fov_for_share(double radius_m, double distance_m, double share) {
    return std::min(2.0 * std::atan(radius_m / share / distance_m), max_fov_rad);
}

} // namespace

double skyline_rad(const Tower& tower, double heading_rad) {
    if (tower.skyline_rad.empty()) { return 0.0; }
    const auto count = static_cast<double>(tower.skyline_rad.size());
    const double turns = heading_rad / (2.0 * pi);
    const double place = (turns - std::floor(turns)) * count;
    const auto first = static_cast<std::size_t>(place) % tower.skyline_rad.size();
    const std::size_t next = (first + 1) % tower.skyline_rad.size();
    return glm::mix(static_cast<double>(tower.skyline_rad[first]), static_cast<double>(tower.skyline_rad[next]),
        place - std::floor(place));
}

Camera tower_camera(const Tower& tower, const glm::dvec3& aircraft_m, double radius_m) {
    const glm::dvec3 to_aircraft_m = aircraft_m - tower.eye_m;
    const double distance_m = std::max(glm::length(to_aircraft_m), radius_m);
    const double elevation_rad = std::asin(std::clamp(to_aircraft_m.z / distance_m, -1.0, 1.0));
    const double above_rad = elevation_rad - skyline_rad(tower, std::atan2(to_aircraft_m.x, to_aircraft_m.y));

    const double close_fov_rad = fov_for_share(radius_m, distance_m, close_share);
    const double wide_rad = fov_for_share(radius_m, distance_m, wide_share);
    const double wanted_rad = std::abs(above_rad) / (aircraft_offset + skyline_offset);
    // 1 where the skyline can be had, 0 where it is so far off that it is given up.
    const double reach = 1.0 - glm::smoothstep(1.0, 1.6, wanted_rad / wide_rad);
    const double fov_rad = glm::mix(close_fov_rad, std::clamp(wanted_rad, close_fov_rad, wide_rad), reach);
    Camera camera = camera_looking_at(tower.eye_m, aircraft_m);
    // Where no ground is in the picture its samples do not hold the lens wide.
    const double recognisable_fov_rad = fov_for_share(radius_m, distance_m, min_share);
    const double lens_fov_rad = std::min(min_lens_fov_rad, recognisable_fov_rad);
    const double ground_fov_rad = std::min(tower.min_fov_rad, recognisable_fov_rad);
    const double sky_share = glm::smoothstep(aircraft_offset + 0.5, 1.1, above_rad / ground_fov_rad);
    camera.vertical_fov_rad = std::max(fov_rad, glm::mix(ground_fov_rad, lens_fov_rad, sky_share));
    const double max_rad = aircraft_offset * camera.vertical_fov_rad;
    const double tilt_rad = reach * std::clamp(0.5 * above_rad, -max_rad, max_rad);
    camera.view_to_world = glm::normalize(camera.view_to_world * glm::angleAxis(-tilt_rad, glm::dvec3(1.0, 0.0, 0.0)));
    return camera;
}

} // namespace octant::visuals::scene
