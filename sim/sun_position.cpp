// Declination: P. I. Cooper, The absorption of radiation in solar stills, Solar Energy 12 (1969), 333-346, equation for
// delta. Elevation and azimuth by the spherical triangle of pole, zenith and sun.
//
// Deviations: none. No refraction and no equation of time: the hour is the sun's own.
#include "sim/sun_position.h"

#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::sim {

namespace {

bool is_leap(int year) { return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0; }

int days_of(int year, int month) {
    constexpr std::array days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return days[static_cast<std::size_t>(month - 1)] + (month == 2 && is_leap(year) ? 1 : 0);
}

/// The digits' number; -1 where something else stands there.
int number_of(std::string_view digits) {
    int number = 0;
    for (const char digit : digits) {
        if (digit < '0' || digit > '9') { return -1; }
        number = 10 * number + (digit - '0');
    }
    return number;
}

} // namespace

SunPosition sun_position(double latitude_deg, double day, double solar_hour) {
    const double declination = rad_from_deg(23.45) * std::sin(2.0 * pi * (284.0 + day) / 365.0);
    const double hour_angle = 2.0 * pi * (solar_hour - 12.0) / 24.0;
    const double latitude = rad_from_deg(latitude_deg);
    // Unit vector to the sun in east, north, up.
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double north =
        std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::sin(latitude) * std::cos(hour_angle);
    const double up =
        std::sin(declination) * std::sin(latitude) + std::cos(declination) * std::cos(latitude) * std::cos(hour_angle);
    const double azimuth_deg = deg_from_rad(std::atan2(east, north));
    return {azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg, deg_from_rad(std::asin(std::clamp(up, -1.0, 1.0)))};
}

std::optional<SolarTime> solar_time_from_text(std::string_view text) {
    constexpr std::string_view form = "YYYY-MM-DDTHH:MM";
    if (text.size() != form.size() || text[4] != '-' || text[7] != '-' || text[10] != 'T' || text[13] != ':') {
        return std::nullopt;
    }
    const int year = number_of(text.substr(0, 4));
    const int month = number_of(text.substr(5, 2));
    const int day = number_of(text.substr(8, 2));
    const int hour = number_of(text.substr(11, 2));
    const int minute = number_of(text.substr(14, 2));
    if (year < 0 || month < 1 || month > 12 || day < 1 || day > days_of(year, month) || hour < 0 || hour > 23 ||
        minute < 0 || minute > 59) {
        return std::nullopt;
    }
    return SolarTime{year, month, day, 60 * hour + minute};
}

int day_of_year(const SolarTime& time) {
    int day = time.day;
    for (int month = 1; month < time.month; ++month) { day += days_of(time.year, month); }
    return day;
}

SolarTime on_day(SolarTime time, int day_of_year) {
    time.month = 1;
    time.day = day_of_year;
    while (time.day > days_of(time.year, time.month)) {
        time.day -= days_of(time.year, time.month);
        ++time.month;
    }
    return time;
}

SunPosition sun_position(double latitude_deg, const SolarTime& time) {
    return sun_position(latitude_deg, day_of_year(time), time.minute / 60.0);
}

} // namespace octant::sim
