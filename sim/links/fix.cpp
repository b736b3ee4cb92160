#include "sim/links/fix.h"

#include <cmath>

namespace octant::sim::links {

namespace {

constexpr double highest_m = 1e6;
constexpr double furthest_m = 1e7;
constexpr double lowest_m = -12000.0;
constexpr double fastest_mps = 20000.0;
constexpr double max_acceleration_mps2 = 2000.0;
constexpr double fastest_turn_radps = 100.0;
constexpr double largest_angle_rad = 100.0;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool within(const glm::dvec3& v, double most) {
    return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

bool is_finite(const Fix& fix) {
    return std::isfinite(fix.latitude_deg) && std::isfinite(fix.longitude_deg) && std::isfinite(fix.altitude_m) &&
           std::isfinite(fix.attitude.heading_rad) && std::isfinite(fix.attitude.pitch_rad) &&
           std::isfinite(fix.attitude.roll_rad) && (!fix.above_ground_m || std::isfinite(*fix.above_ground_m)) &&
           (!fix.above_home_m || std::isfinite(*fix.above_home_m)) &&
           (!fix.velocity_ned_mps || finite(*fix.velocity_ned_mps)) && finite(fix.acceleration_ned_mps2) &&
           (!fix.body_rates_radps || finite(*fix.body_rates_radps)) &&
           (!fix.local_m || (std::isfinite(fix.local_m->x) && std::isfinite(fix.local_m->y))) &&
           (!fix.sent_s || std::isfinite(*fix.sent_s));
}

glm::dvec3 turned(const glm::dvec3& ned, double by_rad) {
    const glm::dvec2 east_north = rotated_clockwise({ned.y, ned.x}, by_rad);
    return {east_north.y, east_north.x, ned.z};
}

} // namespace

Fix with_rotated_axes(Fix fix, double north_bearing_rad) {
    fix.attitude.heading_rad += north_bearing_rad;
    fix.acceleration_ned_mps2 = turned(fix.acceleration_ned_mps2, north_bearing_rad);
    if (fix.velocity_ned_mps) { fix.velocity_ned_mps = turned(*fix.velocity_ned_mps, north_bearing_rad); }
    return fix;
}

PacketError error_of_fix(const Fix& fix) {
    if (!is_finite(fix)) { return PacketError::NotFinite; }
    const glm::dvec3 angles(fix.attitude.heading_rad, fix.attitude.pitch_rad, fix.attitude.roll_rad);
    const bool in_range =
        std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 360.0 && fix.altitude_m >= lowest_m &&
        fix.altitude_m <= highest_m &&
        (!fix.local_m || (std::abs(fix.local_m->x) <= furthest_m && std::abs(fix.local_m->y) <= furthest_m)) &&
        within(angles, largest_angle_rad) && (!fix.above_ground_m || std::abs(*fix.above_ground_m) <= highest_m) &&
        (!fix.above_home_m || std::abs(*fix.above_home_m) <= highest_m) &&
        (!fix.velocity_ned_mps || within(*fix.velocity_ned_mps, fastest_mps)) &&
        within(fix.acceleration_ned_mps2, max_acceleration_mps2) &&
        (!fix.body_rates_radps || within(*fix.body_rates_radps, fastest_turn_radps));
    return in_range ? PacketError::None : PacketError::OutOfRange;
}

} // namespace octant::sim::links
