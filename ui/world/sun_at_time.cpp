#include "ui/world/sun_at_time.h"

#include "sim/sun_position.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::world {

namespace {

std::optional<sim::SunPosition> sun_of(
    const visuals::scene::AirSettings& air, const std::optional<GeoPosition>& place) {
    const auto time = air.time ? sim::solar_time_from_text(*air.time) : std::nullopt;
    return time ? std::optional(sim::sun_position(latitude_of(place), *time)) : std::nullopt;
}

} // namespace

double latitude_of(const std::optional<GeoPosition>& place) {
    constexpr double default_deg = 45.0;
    return place ? place->latitude_deg : default_deg;
}

settings::RunSettings with_sun_at_time(settings::RunSettings settings, const std::optional<GeoPosition>& place) {
    if (const auto sun = sun_of(settings.air, place)) {
        settings.air.sun_azimuth_deg = sun->azimuth_deg;
        settings.air.sun_elevation_deg = std::clamp(sun->elevation_deg, 0.0, 90.0);
    }
    return settings;
}

settings::RunSettings with_sun_updated(
    settings::RunSettings settings, const settings::RunSettings& before, const std::optional<GeoPosition>& place) {
    const bool moved_by_hand =
        settings.air.time == before.air.time && (settings.air.sun_azimuth_deg != before.air.sun_azimuth_deg ||
                                                    settings.air.sun_elevation_deg != before.air.sun_elevation_deg);
    if (moved_by_hand) { settings.air.time.reset(); }
    return with_sun_at_time(std::move(settings), place);
}

std::vector<std::string> sun_notes(const settings::RunSettings& settings, const std::optional<GeoPosition>& place) {
    std::vector<std::string> notes;
    const auto sun = sun_of(settings.air, place);
    if (const Ellipsoid below = ellipsoid_below(place); sun && !below.is_earth()) {
        notes.push_back(
            fmt::format("--time {}: the sun stands as over the earth at this latitude and date, not as over {}",
                *settings.air.time, name_of_body(below)));
    }
    if (sun && sun->elevation_deg < 0.0) {
        notes.push_back(fmt::format("--time {}: the sun is {:.0f} degrees below the horizon at latitude {:.1f}; it is "
                                    "shown on the horizon",
            *settings.air.time, -sun->elevation_deg, latitude_of(place)));
    }
    return notes;
}

} // namespace octant::ui::world
