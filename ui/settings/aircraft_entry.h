#pragma once

#include <optional>
#include <string>

namespace octant::ui::settings {

/// What one entry of PathSettings::aircraft says: "500md", or "500md=turn@10s" for one that flies a path of its own,
/// from 10 s after the first aircraft's beginning on.
struct AircraftEntry {
    std::string shape; ///< a built-in aircraft or a file
    std::optional<std::string> path;
    double from_s = 0.0;
};

/// The whole text is the shape where a file of that name is there. Throws Error for text before or after the = that is
/// missing, and for times that are no number of seconds from 0 to 86,400.
AircraftEntry parse_aircraft_entry(const std::string& text);

/// Just its shape. Throws Error.
std::string aircraft_shape(const std::string& text);

/// Back to text.
std::string text_of(const AircraftEntry& flown);

} // namespace octant::ui::settings
