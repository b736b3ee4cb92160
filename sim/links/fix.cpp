#include "sim/links/fix.h"

#include <algorithm>
#include <cmath>

namespace octant::sim::links {

// Geodetic from earth-centred coordinates by Bowring's iteration on the reduced latitude (B. R. Bowring, Survey Review
// 23 (1976) 323-327); it converges to rounding in three steps.

namespace {

constexpr double e2 = wgs84.e2();
constexpr double flattening = wgs84.flattening;
constexpr double semi_major_m = wgs84.semi_major_m;
constexpr double semi_minor_m = wgs84.semi_minor_m();
constexpr double second_e2 = e2 / (1.0 - e2);

double prime_vertical_m(double latitude_rad) {
    const double sine = std::sin(latitude_rad);
    return semi_major_m / std::sqrt(1.0 - e2 * sine * sine);
}

} // namespace

glm::dvec3 ecef_from_geodetic(const Geodetic& place) {
    const double normal_m = prime_vertical_m(place.latitude_rad);
    const double across_m = (normal_m + place.height_m) * std::cos(place.latitude_rad);
    return {across_m * std::cos(place.longitude_rad), across_m * std::sin(place.longitude_rad),
        (normal_m * (1.0 - e2) + place.height_m) * std::sin(place.latitude_rad)};
}

Geodetic geodetic_from_ecef(const glm::dvec3& ecef_m) {
    const double across_m = std::hypot(ecef_m.x, ecef_m.y);
    double reduced = std::atan2(ecef_m.z * semi_major_m, across_m * semi_minor_m);
    double latitude = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double s = std::sin(reduced);
        const double c = std::cos(reduced);
        latitude =
            std::atan2(ecef_m.z + second_e2 * semi_minor_m * s * s * s, across_m - e2 * semi_major_m * c * c * c);
        reduced = std::atan2((1.0 - flattening) * std::sin(latitude), std::cos(latitude));
    }
    const double sine = std::sin(latitude);
    const double height_m =
        across_m * std::cos(latitude) + ecef_m.z * sine - semi_major_m * std::sqrt(1.0 - e2 * sine * sine);
    return {latitude, std::atan2(ecef_m.y, ecef_m.x), height_m};
}

Geodetic offset_by(const Geodetic& place, const glm::dvec3& ned_m, const Ellipsoid& ellipsoid) {
    constexpr double min_cosine = 1e-3; // the poles have no east
    const double sine = std::sin(place.latitude_rad);
    const double share = 1.0 - ellipsoid.e2() * sine * sine;
    const double normal_m = ellipsoid.semi_major_m / std::sqrt(share);
    const double across_m = normal_m + place.height_m;
    const double along_m = normal_m * (1.0 - ellipsoid.e2()) / share + place.height_m;
    const double cosine = std::max(std::cos(place.latitude_rad), min_cosine);
    return {place.latitude_rad + ned_m.x / along_m, place.longitude_rad + ned_m.y / (across_m * cosine),
        place.height_m - ned_m.z};
}

glm::dmat3 ned_from_ecef(const Geodetic& place) {
    const double sp = std::sin(place.latitude_rad);
    const double cp = std::cos(place.latitude_rad);
    const double sl = std::sin(place.longitude_rad);
    const double cl = std::cos(place.longitude_rad);
    // Columns are what becomes of the earth's x, y and z.
    return {glm::dvec3(-sp * cl, -sl, -cp * cl), glm::dvec3(-sp * sl, cl, -cp * sl), glm::dvec3(cp, 0.0, -sp)};
}

glm::dmat3 ned_from_body(const EulerAngles& angles) {
    const double sh = std::sin(angles.heading_rad);
    const double ch = std::cos(angles.heading_rad);
    const double sp = std::sin(angles.pitch_rad);
    const double cp = std::cos(angles.pitch_rad);
    const double sr = std::sin(angles.roll_rad);
    const double cr = std::cos(angles.roll_rad);
    return {glm::dvec3(ch * cp, sh * cp, -sp), glm::dvec3(ch * sp * sr - sh * cr, sh * sp * sr + ch * cr, cp * sr),
        glm::dvec3(ch * sp * cr + sh * sr, sh * sp * cr - ch * sr, cp * cr)};
}

EulerAngles euler_from_ned_from_body(const glm::dmat3& m) {
    return {wrapped_to_two_pi(std::atan2(m[0].y, m[0].x)), std::asin(std::clamp(-m[0].z, -1.0, 1.0)),
        std::atan2(m[1].z, m[2].z)};
}

namespace {

constexpr double highest_m = 1e6;
constexpr double max_local_m = 1e7;
constexpr double lowest_m = -12000.0;
constexpr double max_fix_speed_mps = 20000.0;
constexpr double max_acceleration_mps2 = 2000.0;
constexpr double max_fix_turn_radps = 100.0;
constexpr double largest_angle_rad = 100.0;

bool all_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool all_within(const glm::dvec3& v, double most) {
    return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

bool is_finite(const Fix& fix) {
    return std::isfinite(fix.latitude_deg) && std::isfinite(fix.longitude_deg) && std::isfinite(fix.altitude_m) &&
           std::isfinite(fix.attitude.heading_rad) && std::isfinite(fix.attitude.pitch_rad) &&
           std::isfinite(fix.attitude.roll_rad) && (!fix.above_ground_m || std::isfinite(*fix.above_ground_m)) &&
           (!fix.above_home_m || std::isfinite(*fix.above_home_m)) &&
           (!fix.velocity_ned_mps || all_finite(*fix.velocity_ned_mps)) && all_finite(fix.acceleration_ned_mps2) &&
           (!fix.body_rates_radps || all_finite(*fix.body_rates_radps)) &&
           (!fix.local_m || (std::isfinite(fix.local_m->x) && std::isfinite(fix.local_m->y))) &&
           (!fix.sent_s || std::isfinite(*fix.sent_s));
}

glm::dvec3 turned_by_bearing(const glm::dvec3& ned, double by_rad) {
    const glm::dvec2 east_north = rotated_clockwise({ned.y, ned.x}, by_rad);
    return {east_north.y, east_north.x, ned.z};
}

} // namespace

Fix with_rotated_axes(Fix fix, double north_bearing_rad) {
    fix.attitude.heading_rad += north_bearing_rad;
    fix.acceleration_ned_mps2 = turned_by_bearing(fix.acceleration_ned_mps2, north_bearing_rad);
    if (fix.velocity_ned_mps) { fix.velocity_ned_mps = turned_by_bearing(*fix.velocity_ned_mps, north_bearing_rad); }
    return fix;
}

PacketError error_of_fix(const Fix& fix) {
    if (!is_finite(fix)) { return PacketError::NotFinite; }
    const glm::dvec3 angles(fix.attitude.heading_rad, fix.attitude.pitch_rad, fix.attitude.roll_rad);
    const bool in_range =
        std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 360.0 && fix.altitude_m >= lowest_m &&
        fix.altitude_m <= highest_m &&
        (!fix.local_m || (std::abs(fix.local_m->x) <= max_local_m && std::abs(fix.local_m->y) <= max_local_m)) &&
        all_within(angles, largest_angle_rad) && (!fix.above_ground_m || std::abs(*fix.above_ground_m) <= highest_m) &&
        (!fix.above_home_m || std::abs(*fix.above_home_m) <= highest_m) &&
        (!fix.velocity_ned_mps || all_within(*fix.velocity_ned_mps, max_fix_speed_mps)) &&
        all_within(fix.acceleration_ned_mps2, max_acceleration_mps2) &&
        (!fix.body_rates_radps || all_within(*fix.body_rates_radps, max_fix_turn_radps));
    return in_range ? PacketError::None : PacketError::OutOfRange;
}

} // namespace octant::sim::links
