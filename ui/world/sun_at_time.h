#pragma once

#include "sim/base/earth_frame.h"
#include "ui/settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// 45 degrees north for ground without a place.
double latitude_of(const std::optional<GeoPosition>& place);

/// The settings with the sun where it stands at their time and that place, on the horizon at night; the same settings
/// where they name no time, which has passed settings::check_settings.
settings::RunSettings with_sun_at_time(settings::RunSettings settings, const std::optional<GeoPosition>& place);

/// As with_sun_at_time(), for settings that change from `before`: where the sun was moved by hand (the sun differs, the
/// time does not), the time is cleared.
settings::RunSettings with_sun_updated(
    settings::RunSettings settings, const settings::RunSettings& before, const std::optional<GeoPosition>& place);

/// Notes on the sun of the settings' time: that it is the earth's, over another planet, or below the horizon.
std::vector<std::string> sun_notes(const settings::RunSettings& settings, const std::optional<GeoPosition>& place);

} // namespace octant::ui::world
