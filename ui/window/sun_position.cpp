// Declination: P. I. Cooper, The absorption of radiation in solar stills, Solar Energy 12 (1969),
// 333-346, equation for delta. Elevation and azimuth by the spherical triangle of pole, zenith and
// sun.
//
// Deviations: none. No refraction and no equation of time: the hour is the sun's own.
#include "ui/window/sun_position.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cmath>

namespace octant::ui::window {

SunPosition sun_position(double latitude_deg, double day, double solar_hour) {
    const double declination = rad_from_deg(23.45) * std::sin(2.0 * pi * (284.0 + day) / 365.0);
    const double hour_angle = 2.0 * pi * (solar_hour - 12.0) / 24.0;
    const double latitude = rad_from_deg(latitude_deg);
    // Unit vector to the sun in east, north, up.
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double north = std::sin(declination) * std::cos(latitude) -
                         std::cos(declination) * std::sin(latitude) * std::cos(hour_angle);
    const double up = std::sin(declination) * std::sin(latitude) +
                      std::cos(declination) * std::cos(latitude) * std::cos(hour_angle);
    const double azimuth_deg = deg_from_rad(std::atan2(east, north));
    return {
        azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg,
        deg_from_rad(std::asin(std::clamp(up, -1.0, 1.0)))};
}

} // namespace octant::ui::window
