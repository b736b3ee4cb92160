#pragma once

#include <optional>
#include <string_view>

namespace octant::sim {

/// The direction in which the sun stands.
struct SunPosition {
    /// Angle clockwise from north, 0 to 360.
    double azimuth_deg = 0.0;
    /// Angle of the sun's centre above the horizon, below zero at night.
    double elevation_deg = 0.0;
};

/// Returns the sun's position to about a degree. `day` counts from 1 at the beginning of the year; `solar_hour` runs
/// from 0 to 24, and the sun is highest at 12. At the poles, and with the sun overhead, the azimuth is arbitrary.
SunPosition sun_position(double latitude_deg, double day, double solar_hour);

/// A day of the Gregorian calendar, and a minute of it by the sun's own time.
struct SolarTime {
    int year = 2000;
    /// From 1.
    int month = 1;
    /// Of the month, from 1.
    int day = 1;
    /// From midnight, below 24 * 60.
    int minute = 0;

    bool operator==(const SolarTime&) const = default;
};

/// Reads "YYYY-MM-DDTHH:MM"; nothing where the text is not that or no day has that number.
std::optional<SolarTime> solar_time_from_text(std::string_view text);

/// 1 on the first of January.
int day_of_year(const SolarTime& time);

/// That time on another day of its year; `day_of_year` from 1 to 365.
SolarTime on_day(SolarTime time, int day_of_year);

SunPosition sun_position(double latitude_deg, const SolarTime& time);

} // namespace octant::sim
