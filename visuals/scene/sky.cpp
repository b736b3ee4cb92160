#include "visuals/scene/sky.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace octant::visuals::scene {

namespace {

constexpr int spokes = 24;
constexpr float dome_radius_m = 1000.0F; ///< only its direction shows: the sky has no depth
constexpr glm::vec3 zenith_colour(0.20F, 0.40F, 0.72F);

/// Elevations of the rings above the horizon, degrees, from the zenith down.
constexpr std::array rings_above_deg = {90.0, 60.0, 40.0, 25.0, 15.0, 8.0, 4.0, 1.5, 0.0};
constexpr int rings_below = 7;
constexpr int rings = static_cast<int>(rings_above_deg.size()) + rings_below;

glm::vec3 colour_above(double elevation_rad, const glm::vec3& horizon) {
    const auto share = static_cast<float>(std::exp(-elevation_rad / rad_from_deg(16.0)));
    return glm::mix(zenith_colour, horizon, share);
}

/// Distance at which a look down meets the plain; nothing above its horizon.
std::optional<double> distance_to_plain_m(double depression_rad, const Plain& plain) {
    if (plain.height_below_eye_m <= 0.0 || depression_rad <= 0.0) {
        return std::nullopt;
    }
    if (plain.earth_radius_m <= 0.0) {
        return plain.height_below_eye_m / std::sin(depression_rad);
    }
    // The nearer root of h + d^2 / 2R = d tan(depression).
    const double slope = std::tan(depression_rad);
    const double under = slope * slope - 2.0 * plain.height_below_eye_m / plain.earth_radius_m;
    if (under < 0.0) {
        return std::nullopt;
    }
    return 2.0 * plain.height_below_eye_m / (slope + std::sqrt(under)) / std::cos(depression_rad);
}

glm::vec3 colour_below(double depression_rad, const Plain& plain, const Haze& haze) {
    const auto distance_m = distance_to_plain_m(depression_rad, plain);
    if (!distance_m) {
        return haze.colour;
    }
    const double left = haze.visibility_m > 0.0F
                            ? std::exp(-*distance_m / static_cast<double>(haze.visibility_m))
                            : 1.0;
    return glm::mix(haze.colour, plain.colour, static_cast<float>(left));
}

/// Steepest look down at which the plain can show past the edge of the map, with a margin for
/// ground that lies lower than the plain.
double deepest_rad(const Plain& plain) {
    const double height_m = std::max(plain.height_below_eye_m, 0.0) + 200.0;
    const double deepest = std::atan2(2.0 * height_m, std::max(plain.map_edge_m, 1.0));
    return std::clamp(deepest, rad_from_deg(3.0), pi / 2.0);
}

} // namespace

Sky::Sky() {
    vertices_.resize(static_cast<std::size_t>(rings) * spokes);
    for (int ring = 0; ring + 1 < rings; ++ring) {
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const auto upper = static_cast<std::uint32_t>(ring * spokes);
            const auto lower = upper + spokes;
            const auto here = static_cast<std::uint32_t>(spoke);
            const auto next = static_cast<std::uint32_t>((spoke + 1) % spokes);
            // Counter-clockwise seen from the inside of the dome.
            indices_.insert(indices_.end(), {upper + here, lower + next, lower + here});
            indices_.insert(indices_.end(), {upper + here, upper + next, lower + next});
        }
    }
}

TriangleDraw Sky::around(const Plain& plain, const Haze& haze) {
    const double deepest = deepest_rad(plain);
    for (int ring = 0; ring < rings; ++ring) {
        const int below = ring + 1 - static_cast<int>(rings_above_deg.size());
        // Below the horizon the rings crowd towards it, where the plain's colour changes fastest.
        const double share = std::max(below, 0) / static_cast<double>(rings_below);
        const double elevation_rad =
            below > 0 ? -deepest * share * share
                      : rad_from_deg(rings_above_deg[static_cast<std::size_t>(ring)]);
        const std::uint32_t colour = models::packed_colour(
            below > 0 ? colour_below(-elevation_rad, plain, haze)
                      : colour_above(elevation_rad, haze.colour));
        const glm::dvec2 ray(std::cos(elevation_rad), std::sin(elevation_rad));
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const glm::dvec3 level = direction_from_heading(2.0 * pi * spoke / spokes);
            const glm::vec3 direction(glm::dvec3(ray.x * level.x, ray.x * level.y, ray.y));
            vertices_[static_cast<std::size_t>(ring * spokes + spoke)] = {
                dome_radius_m * direction, colour};
        }
    }
    return {vertices_, indices_};
}

} // namespace octant::visuals::scene
