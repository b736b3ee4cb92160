#pragma once

namespace octant::ui::window {

/// Where the sun stands.
struct SunPosition {
    double azimuth_deg = 0.0;   ///< clockwise from north, 0 .. 360
    double elevation_deg = 0.0; ///< of its centre above the horizon, below zero at night
};

/// `day` of the year from 1; `solar_hour` 0 .. 24, the sun is highest at 12. At the poles, and with
/// the sun overhead, the azimuth is some direction. Within about a degree.
SunPosition sun_position(double latitude_deg, double day, double solar_hour);

} // namespace octant::ui::window
