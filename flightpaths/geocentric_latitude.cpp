#include "flightpaths/geocentric_latitude.h"

#include "sim/base/geo_position.h"
#include "sim/base/units.h"

#include <cmath>

namespace octant::flightpaths {

double geodetic_from_geocentric_deg(double geocentric_deg, double height_m) {
    const double geocentric_rad = rad_from_deg(geocentric_deg);
    constexpr double e2 = wgs84.e2();
    double geodetic_rad = geocentric_rad;
    for (int i = 0; i < 5; ++i) { // each step leaves less than a hundredth of the error
        const double sine = std::sin(geodetic_rad);
        const double normal_m = wgs84.semi_major_m / std::sqrt(1.0 - e2 * sine * sine);
        geodetic_rad = std::atan2(
            std::sin(geocentric_rad) * (normal_m + height_m),
            std::cos(geocentric_rad) * (normal_m * (1.0 - e2) + height_m));
    }
    return deg_from_rad(geodetic_rad);
}

} // namespace octant::flightpaths
