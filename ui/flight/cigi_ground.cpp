#include "ui/flight/cigi_ground.h"

#include "sim/base/axes.h"
#include "sim/base/transverse_mercator.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::ui::flight {

namespace {

constexpr double step_m = 2.0;
constexpr double max_steps = 10000.0;
constexpr double found_m = 0.01;
constexpr int max_split_depth = 64;

} // namespace

const EarthFrame& WorldCigiGround::frame() const {
    return frame_or_at_zero(place_.frame());
}

glm::dvec3 WorldCigiGround::world_position(const glm::dvec3& place) const {
    return {frame().local_from_geo({place.x, place.y}), place.z};
}

glm::dvec3 WorldCigiGround::geodetic_position(const glm::dvec3& at_m) const {
    const GeoPosition geo = frame().geo_from_local(glm::dvec2(at_m.x, at_m.y));
    return {geo.latitude_deg, geo.longitude_deg, at_m.z};
}

std::optional<double> WorldCigiGround::height_m(const glm::dvec3& at_m) const {
    return place_.frame() != nullptr ? world_.scene.ground->height_at(at_m.x, at_m.y)
                                     : std::nullopt;
}

std::optional<sim::links::CigiSurfacePoint> WorldCigiGround::below(const glm::dvec3& place) const {
    const FramePosition local = frame().place_of({place.x, place.y});
    const glm::dvec3 at_m(local.east_north_m, place.z);
    const auto ground_m = height_m(at_m);
    if (!ground_m) {
        return std::nullopt;
    }
    constexpr double aside_m = 0.5;
    const auto slope = [&](const glm::dvec3& along) {
        const double ahead_m = height_m(at_m + along).value_or(*ground_m);
        const double behind_m = height_m(at_m - along).value_or(*ground_m);
        return (ahead_m - behind_m) / (2.0 * aside_m);
    };
    const glm::dvec3 normal = glm::normalize(glm::dvec3(
        -slope(glm::dvec3(aside_m, 0.0, 0.0)), -slope(glm::dvec3(0.0, aside_m, 0.0)), 1.0));
    return sim::links::CigiSurfacePoint{
        glm::dvec3(place.x, place.y, *ground_m),
        wrapped_to_two_pi(std::atan2(normal.x, normal.y) - local.north_bearing_rad),
        std::asin(std::clamp(normal.z, -1.0, 1.0))};
}

std::optional<sim::links::CigiGround::TerrainHit>
WorldCigiGround::first_hit(const glm::dvec3& from, const glm::dvec3& to) const {
    const glm::dvec3 from_m = world_position(from);
    const glm::dvec3 to_m = world_position(to);
    const double length_m = glm::length(to_m - from_m);
    const double steps = std::clamp(std::ceil(length_m / step_m), 1.0, max_steps);
    const auto is_under = [&](double share) {
        const glm::dvec3 at_m = glm::mix(from_m, to_m, share);
        const auto ground_m = height_m(at_m);
        return ground_m && at_m.z < *ground_m;
    };
    double open = 0.0;
    for (double step = 1.0; step <= steps; step += 1.0) {
        double met = step / steps;
        if (!is_under(met)) {
            open = met;
            continue;
        }
        // Bounded: of points very far away no two may be found_m apart.
        for (int i = 0; i < max_split_depth && (met - open) * length_m > found_m; ++i) {
            const double middle = 0.5 * (open + met);
            (is_under(middle) ? met : open) = middle;
        }
        const auto surface = below(geodetic_position(glm::mix(from_m, to_m, met)));
        return surface ? std::optional(TerrainHit{met * length_m, *surface}) : std::nullopt;
    }
    return std::nullopt;
}

double WorldCigiGround::distance_m(const glm::dvec3& from, const glm::dvec3& to) const {
    return glm::length(world_position(to) - world_position(from));
}

glm::dvec3 WorldCigiGround::moved(const glm::dvec3& place, const glm::dvec3& ned_m) const {
    const FramePosition local = frame().place_of({place.x, place.y});
    const glm::dvec2 moved_m = rotated_clockwise({ned_m.y, ned_m.x}, local.north_bearing_rad);
    return geodetic_position({local.east_north_m + moved_m, place.z - ned_m.z});
}

} // namespace octant::ui::flight
