#pragma once

#include "sim/base/earth_frame.h"
#include "ui/settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Where the sun is worked out for ground without a place.
inline constexpr double default_latitude_deg = 45.0;

double latitude_of(const std::optional<GeoPosition>& place);

/// The settings with the sun where it stands at their time and that place, on the horizon at night; the same settings
/// where they name no time, which has passed settings::check_settings.
settings::RunSettings with_sun_at_time(settings::RunSettings settings, const std::optional<GeoPosition>& place);

/// The same for settings that follow others: where their time is that of before and their sun is not, the sun was moved
/// by hand, and they name no time any more.
settings::RunSettings with_sun_updated(
    settings::RunSettings settings, const settings::RunSettings& before, const std::optional<GeoPosition>& place);

/// What a person should be told of the sun of the settings' time: that it is the earth's, over another planet, and that
/// it is below the horizon.
std::vector<std::string> sun_notes(const settings::RunSettings& settings, const std::optional<GeoPosition>& place);

} // namespace octant::ui::world
