// Geodetic from earth-centred coordinates by Bowring's iteration on the reduced latitude (B. R. Bowring, Survey Review
// 23 (1976) 323-327); it converges to rounding in three steps.

#include "sim/links/earth.h"

#include <algorithm>
#include <cmath>

namespace octant::sim::links {

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

} // namespace octant::sim::links
