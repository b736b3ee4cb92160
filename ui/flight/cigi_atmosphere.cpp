#include "ui/flight/cigi_atmosphere.h"

#include "sim/sun_position.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <string>

namespace octant::ui::flight {

namespace links = sim::links;

namespace {

/// The sun's own time at a longitude; nothing where the date is none.
std::optional<std::string> solar_time(const links::CigiCelestial& universal, double longitude_deg) {
    namespace chrono = std::chrono;
    constexpr unsigned century = 100;
    constexpr unsigned ten_thousand = 10000;
    const chrono::year_month_day date(
        chrono::year(static_cast<int>(universal.date % ten_thousand)),
        chrono::month(universal.date / (century * ten_thousand)),
        chrono::day(universal.date / ten_thousand % century));
    constexpr double minutes_a_degree = 4.0;
    if (!date.ok()) {
        return std::nullopt;
    }
    const auto time =
        chrono::sys_days(date) + chrono::hours(universal.hour) +
        chrono::minutes(universal.minute + std::lround(minutes_a_degree * longitude_deg));
    const auto day = chrono::floor<chrono::days>(time);
    const chrono::year_month_day there(day);
    const auto minute = (time - day).count();
    std::string text = fmt::format(
        "{:04}-{:02}-{:02}T{:02}:{:02}",
        static_cast<int>(there.year()),
        static_cast<unsigned>(there.month()),
        static_cast<unsigned>(there.day()),
        minute / 60,
        minute % 60);
    return sim::solar_time_from_text(text) ? std::optional(std::move(text)) : std::nullopt;
}

} // namespace

visuals::scene::AirSettings air_from_cigi(
    visuals::scene::AirSettings defaults,
    const std::optional<links::CigiAtmosphere>& atmosphere,
    const std::optional<links::CigiCelestial>& celestial,
    const std::optional<GeoPosition>& place) {
    if (atmosphere) {
        constexpr double min_m = 50.0;
        constexpr double max_m = 5e5;
        defaults.visibility_m = std::clamp(atmosphere->visibility_m, min_m, max_m);
    }
    if (celestial && celestial->is_valid) {
        const double longitude_deg = place ? place->longitude_deg : 0.0;
        if (auto time = solar_time(*celestial, longitude_deg)) {
            defaults.time = std::move(time);
        }
    }
    return defaults;
}

} // namespace octant::ui::flight
