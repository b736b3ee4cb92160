#pragma once

#include "ui/settings/settings.h"

#include <string>

namespace octant::tests {

/// Settings that show cracks: no sky, no haze, a background colour that nothing else has, an aircraft too small to be
/// seen that flies an aircraft's path.
ui::settings::RunSettings key_colour_settings(
    const std::string& path, const std::string& aircraft, const std::string& terrain, double rate_hz);

/// Crack pixels over all frames of a flight: pixels of the background's colour with a ground pixel above them in their
/// column.
long cracks_in_flight(const ui::settings::RunSettings& settings);

/// The two together.
long cracks_along(const std::string& path, const std::string& aircraft, const std::string& terrain, double rate_hz);

} // namespace octant::tests
