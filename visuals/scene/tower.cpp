#include "visuals/scene/tower.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

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
    // 1 where the skyline fits into the picture, 0 where it is too far away from the aircraft.
    const double reach = 1.0 - glm::smoothstep(1.0, 1.6, wanted_rad / wide_rad);
    const double fov_rad = glm::mix(close_fov_rad, std::clamp(wanted_rad, close_fov_rad, wide_rad), reach);
    Camera camera = camera_looking_at(tower.eye_m, aircraft_m);
    // Without ground in the picture its samples do not limit the lens.
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

// The site of the tower. Candidates near the flight are scored by few views of the flight along
// coarse lines of sight. The best of them are scored again by many views along fine lines of sight.

namespace {

/// The distance up to which relief is searched.
constexpr double farthest_m = 30000.0;
/// The number of directions in which the skyline is known.
constexpr int headings = 360;
/// Samples of the ground that the height of a picture should span, where few show and many do.
constexpr double few_samples = 6.0;
constexpr double many_samples = 30.0;
/// Turning rates that an operator follows well, and not at all.
constexpr double slow_turn_radps = 0.35;
constexpr double fast_turn_radps = 1.1;
/// The steepest that a tower should look up at the aircraft.
constexpr double steep_rad = rad_from_deg(35.0);
/// The elevation of a look that shows nothing but sky.
constexpr double upright_rad = rad_from_deg(65.0);
/// The clearance of a line of sight above the ground; near the tower it is larger, because trees would fill a narrow
/// lens.
constexpr double spare_m = 1.0;
constexpr double trees_m = 16.0;
constexpr double near_trees_m = 250.0;

/// How finely a line of sight is walked: each step is longer than the one before by this factor.
constexpr double coarse_step_ratio = 1.12;
constexpr double fine_step_ratio = 1.03;

/// The distances of sites from the flight, in radii of the aircraft, and their heights above the ground.
constexpr std::array sideways_radii = {7.0, 14.0, 28.0, 56.0, 112.0, 224.0};
constexpr std::array heights_m = {20.0, 40.0, 90.0};
/// The largest number of points of the flight near which sites are searched.
constexpr std::size_t max_stations = 24;
/// The number of views of the flight by which all sites are compared.
constexpr std::size_t coarse_frame_count = 32;
/// The number of sites that are then compared finely.
constexpr std::size_t fine_candidate_count = 16;

double rising(double low, double high, double value) { return glm::smoothstep(low, high, value); }

/// The ground along a line of sight to the aircraft and beyond it.
struct Sightline {
    /// Whether no ground hides the aircraft.
    bool free = true;
    /// The elevation of the skyline beyond it.
    double skyline_rad = 0.0;
    /// The distance of the ground behind the aircraft in the picture.
    double behind_m = farthest_m;
    /// The distance of the skyline.
    double skyline_m = farthest_m;
};

/// Walks from an eye at a heading; the aircraft is `aircraft_m` off, level, under this slope.
Sightline trace_sightline(const glm::dvec3& eye_m, const glm::dvec2& level, double aircraft_m, double slope,
    double walk, const GroundHeight& ground) {
    Sightline sightline;
    double highest = -1.0;
    for (double level_m = 4.0; level_m < farthest_m; level_m *= walk) {
        const auto height_m = ground(eye_m.x + level_m * level.x, eye_m.y + level_m * level.y);
        if (!height_m) {
            break; // the map ends
        }
        const double rise = (*height_m - eye_m.z) / level_m;
        if (level_m < aircraft_m) {
            const double room_m = level_m < near_trees_m ? trees_m : spare_m;
            sightline.free = sightline.free && *height_m + room_m < eye_m.z + slope * level_m;
        } else if (rise > slope && sightline.behind_m == farthest_m) {
            sightline.behind_m = level_m;
        }
        if (rise > highest) {
            highest = rise;
            sightline.skyline_m = level_m;
        }
    }
    sightline.skyline_rad = std::max(std::atan(highest), 0.0);
    return sightline;
}

/// The step with which at most `max` of `count` things are visited.
std::size_t stride_for(std::size_t count, std::size_t max) { return std::max<std::size_t>((count + max - 1) / max, 1); }

/// The narrowest field of view that spans many samples of ground so far off.
double fov_for_samples(double distance_m, const TowerRequest& request) {
    return std::max(many_samples * request.spacing_m / distance_m, min_lens_fov_rad);
}

/// How well the aircraft is seen in one state, 0..1.
double seen_from(const glm::dvec3& eye_m, const sim::AircraftState& state, const TowerRequest& request, double walk,
    const GroundHeight& ground) {
    const glm::dvec3 to_aircraft_m = state.position_m - eye_m;
    const double distance_m = glm::length(to_aircraft_m);
    const double level_m = glm::length(glm::dvec2(to_aircraft_m));
    if (distance_m < 2.0 * request.radius_m || level_m < 1e-3) { return 0.0; }
    const Sightline sightline =
        trace_sightline(eye_m, glm::dvec2(to_aircraft_m) / level_m, level_m, to_aircraft_m.z / level_m, walk, ground);
    if (!sightline.free) { return 0.0; }
    const double background_m = std::min(sightline.behind_m, sightline.skyline_m);
    const Tower tower{eye_m, {static_cast<float>(sightline.skyline_rad)}, fov_for_samples(background_m, request)};
    const Camera camera = tower_camera(tower, state.position_m, request.radius_m);
    const double fov_rad = camera.vertical_fov_rad;
    const double share = request.radius_m / (distance_m * std::tan(0.5 * fov_rad));
    const double off = std::abs(std::asin(view_direction(camera).z) - sightline.skyline_rad) / fov_rad;
    const double samples = request.spacing_m > 0.0 ? fov_rad * background_m / request.spacing_m : many_samples;
    const double in_plane_mps = glm::length(glm::cross(to_aircraft_m, state.velocity_mps)) / distance_m;
    const double elevation_rad = std::asin(to_aircraft_m.z / distance_m);
    const double slowness = 1.0 - rising(slow_turn_radps, fast_turn_radps, in_plane_mps / distance_m);
    const double flat = 1.0 - 0.7 * rising(steep_rad, upright_rad, std::abs(elevation_rad));
    const double balance = 1.0 - rising(0.25, 0.5, off);
    return slowness * flat *
           (rising(0.08, 0.4, share) * (0.21 + 0.04 * balance) +
               0.75 * balance * (0.3 + 0.7 * rising(few_samples, many_samples, samples)));
}

double score(
    const glm::dvec3& eye_m, const TowerRequest& request, std::size_t looks, double walk, const GroundHeight& ground) {
    const std::size_t stride = stride_for(request.flight.size(), looks);
    double sum = 0.0;
    int in_sight = 0;
    int count = 0;
    for (std::size_t i = 0; i < request.flight.size(); i += stride, ++count) {
        const double seen = seen_from(eye_m, request.flight[i], request, walk, ground);
        sum += seen;
        in_sight += seen > 0.0 ? 1 : 0;
    }
    // Good views at other times make up for little of the times at which nothing is visible.
    const double kept = count > 0 ? static_cast<double>(in_sight) / count : 0.0;
    return count > 0 ? kept * kept * kept * sum / count : 0.0;
}

/// The candidates for the site: points on the ground near the flight, each at every height.
std::vector<glm::dvec3> candidate_sites(const TowerRequest& request, const GroundHeight& ground) {
    std::vector<glm::dvec3> candidates;
    const std::size_t stride = stride_for(request.flight.size(), max_stations);
    for (std::size_t i = 0; i < request.flight.size(); i += stride) {
        const sim::AircraftState& state = request.flight[i];
        const glm::dvec2 course(state.velocity_mps);
        const double speed_mps = glm::length(course);
        const glm::dvec2 ahead = speed_mps > 1e-3 ? course / speed_mps : glm::dvec2(0.0, 1.0);
        for (const double radii : sideways_radii) {
            for (const double side : {-1.0, 1.0}) {
                const glm::dvec2 at_m =
                    glm::dvec2(state.position_m) + side * radii * request.radius_m * glm::dvec2(ahead.y, -ahead.x);
                const auto height_m = ground(at_m.x, at_m.y);
                for (const double above_m : heights_m) {
                    if (height_m) { candidates.emplace_back(at_m, *height_m + above_m); }
                }
            }
        }
    }
    return candidates;
}

/// The skyline, evened out so that the camera does not nod at every peak.
std::vector<float> skyline_of(const glm::dvec3& eye_m, const GroundHeight& ground) {
    std::vector<double> sharp_rad;
    for (int i = 0; i < headings; ++i) {
        const glm::dvec2 level(direction_from_heading(2.0 * pi * i / headings));
        sharp_rad.push_back(trace_sightline(eye_m, level, 0.0, 2.0 * farthest_m, fine_step_ratio, ground).skyline_rad);
    }
    constexpr int reach = 4;
    std::vector<float> even_rad;
    for (int i = 0; i < headings; ++i) {
        double sum = 0.0;
        double weights = 0.0;
        for (int by = -reach; by <= reach; ++by) {
            const double weight = reach + 1 - std::abs(by);
            sum += weight * sharp_rad[static_cast<std::size_t>((i + by + headings) % headings)];
            weights += weight;
        }
        even_rad.push_back(static_cast<float>(sum / weights));
    }
    return even_rad;
}

/// The narrowest field of view that spans many samples of the ground behind most of the flight.
double min_sampled_fov_rad(const glm::dvec3& eye_m, const TowerRequest& request, const GroundHeight& ground) {
    std::vector<double> behind_m;
    for (const sim::AircraftState& state : request.flight) {
        const glm::dvec2 level_m(state.position_m - eye_m);
        const double size_m = std::max(glm::length(level_m), 1e-3);
        const double slope = (state.position_m.z - eye_m.z) / size_m;
        const Sightline sightline = trace_sightline(eye_m, level_m / size_m, size_m, slope, coarse_step_ratio, ground);
        behind_m.push_back(std::min(sightline.behind_m, sightline.skyline_m));
    }
    if (behind_m.empty()) { return min_lens_fov_rad; }
    const auto middle = behind_m.begin() + static_cast<std::ptrdiff_t>(behind_m.size() / 2);
    std::nth_element(behind_m.begin(), middle, behind_m.end());
    return fov_for_samples(*middle, request);
}

} // namespace

double tower_score(const glm::dvec3& eye_m, const TowerRequest& request, const GroundHeight& ground) {
    return request.flight.empty() ? 0.0 : score(eye_m, request, request.flight.size(), fine_step_ratio, ground);
}

Tower tower_at(glm::dvec3 eye_m, const TowerRequest& request, const GroundHeight& ground) {
    lift_above_ground(eye_m, ground);
    return {eye_m, skyline_of(eye_m, ground), min_sampled_fov_rad(eye_m, request, ground)};
}

Tower tower_for(const TowerRequest& request, const GroundHeight& ground) {
    std::vector<std::pair<double, glm::dvec3>> candidates;
    for (const glm::dvec3& site_m : candidate_sites(request, ground)) {
        candidates.emplace_back(score(site_m, request, coarse_frame_count, coarse_step_ratio, ground), site_m);
    }
    if (candidates.empty()) {
        constexpr double default_height_m = 25.0;
        const double ground_m = ground(request.fallback_m.x, request.fallback_m.y).value_or(0.0);
        return tower_at({request.fallback_m, ground_m + default_height_m}, request, ground);
    }
    std::ranges::stable_sort(candidates, [](const auto& a, const auto& b) { return a.first > b.first; });
    candidates.resize(std::min(candidates.size(), fine_candidate_count));
    for (auto& [value, site_m] : candidates) { value = tower_score(site_m, request, ground); }
    const auto best =
        std::ranges::max_element(candidates, [](const auto& a, const auto& b) { return a.first < b.first; });
    return tower_at(best->second, request, ground);
}

} // namespace octant::visuals::scene
