#include "ui/settings/aircraft_entry.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <fmt/format.h>

namespace octant::ui::settings {

namespace {

/// Takes "@10s" off a path. Nothing where there is none.
std::optional<double> split_start_time(std::string& path, const std::string& whole) {
    const std::size_t at = path.rfind('@');
    if (at == std::string::npos || is_file(path)) { return std::nullopt; }
    std::string digits = path.substr(at + 1);
    if (digits.ends_with('s')) { digits.pop_back(); }
    constexpr double longest_s = 86400.0;
    const auto time_s = finite_number(digits);
    if (!time_s || *time_s < 0.0 || *time_s > longest_s) {
        throw Error(fmt::format("aircraft: expected seconds from 0 to {:.0f} after the @, such as 500md=turn@10s, got "
                                "'{}'",
            longest_s, printable(whole)));
    }
    path.resize(at);
    return time_s;
}

} // namespace

AircraftEntry parse_aircraft_entry(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || is_file(text)) { return {text, std::nullopt, 0.0}; }
    AircraftEntry flown{text.substr(0, equals), text.substr(equals + 1), 0.0};
    flown.from_s = split_start_time(*flown.path, text).value_or(0.0);
    if (flown.shape.empty() || flown.path->empty()) {
        throw Error(fmt::format("aircraft: expected NAME=PATH, such as 500md=turn@10s, got '{}'", printable(text)));
    }
    return flown;
}

std::string aircraft_shape(const std::string& text) { return parse_aircraft_entry(text).shape; }

std::string text_of(const AircraftEntry& flown) {
    if (!flown.path) { return flown.shape; }
    return flown.from_s > 0.0 ? fmt::format("{}={}@{}s", flown.shape, *flown.path, flown.from_s)
                              : fmt::format("{}={}", flown.shape, *flown.path);
}

} // namespace octant::ui::settings
