#pragma once

namespace octant::ui::window {

/// The direction in which the sun stands.
struct SunPosition {
    /// Angle clockwise from north, 0 to 360.
    double azimuth_deg = 0.0;
    /// Angle of the sun's centre above the horizon, below zero at night.
    double elevation_deg = 0.0;
};

/// Returns the sun's position to about a degree. `day` counts from 1 at the beginning of the year;
/// `solar_hour` runs from 0 to 24, and the sun is highest at 12. At the poles, and with the sun
/// overhead, the azimuth is arbitrary.
SunPosition sun_position(double latitude_deg, double day, double solar_hour);

} // namespace octant::ui::window
