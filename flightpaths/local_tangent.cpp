// Radii of curvature of the meridian and of the prime vertical: any text on geodesy, e.g. Snyder,
// Map Projections: A Working Manual (USGS Professional Paper 1395), eqs. 4-18 and 4-20.

#include "flightpaths/local_tangent.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <cmath>

namespace octant::flightpaths {

namespace {

/// Metres a radian of longitude (x) and of latitude (y).
glm::dvec2 metres_a_radian(const GeoPlace& origin) {
    const double latitude_rad = rad_from_deg(origin.latitude_deg);
    const double sine = std::sin(latitude_rad);
    const double w2 = 1.0 - wgs84::e2 * sine * sine;
    const double prime_m = wgs84::semi_major_m / std::sqrt(w2);
    return {prime_m * std::cos(latitude_rad), prime_m * (1.0 - wgs84::e2) / w2};
}

} // namespace

glm::dvec2 local_from_geo(const GeoPlace& origin, double latitude_deg, double longitude_deg) {
    const glm::dvec2 scale = metres_a_radian(origin);
    const double east_rad = wrapped_to_pi(rad_from_deg(longitude_deg - origin.longitude_deg));
    const double north_rad = rad_from_deg(latitude_deg - origin.latitude_deg);
    return {scale.x * east_rad, scale.y * north_rad};
}

GeoPlace geo_from_local(const GeoPlace& origin, const glm::dvec2& east_north_m) {
    const glm::dvec2 scale = metres_a_radian(origin);
    return {
        origin.latitude_deg + deg_from_rad(east_north_m.y / scale.y),
        origin.longitude_deg + deg_from_rad(east_north_m.x / scale.x)};
}

double geodetic_from_geocentric_deg(double geocentric_deg, double height_m) {
    const double geocentric_rad = rad_from_deg(geocentric_deg);
    double geodetic_rad = geocentric_rad;
    for (int i = 0; i < 5; ++i) { // each step leaves less than a hundredth of the error
        const double sine = std::sin(geodetic_rad);
        const double normal_m = wgs84::semi_major_m / std::sqrt(1.0 - wgs84::e2 * sine * sine);
        geodetic_rad = std::atan2(
            std::sin(geocentric_rad) * (normal_m + height_m),
            std::cos(geocentric_rad) * (normal_m * (1.0 - wgs84::e2) + height_m));
    }
    return deg_from_rad(geodetic_rad);
}

} // namespace octant::flightpaths
