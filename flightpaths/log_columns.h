#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// What a column of another program's log means.
enum class LogQuantity {
    Time,
    Latitude,
    Longitude,
    /// Latitude and longitude in one field, separated by a comma.
    Position,
    Altitude,
    Roll,
    Pitch,
    Heading,
    NorthSpeed,
    EastSpeed,
    DownSpeed,
    Count
};

struct LogColumn {
    std::size_t field = 0;
    /// As the log has it.
    std::string name;
    /// What the values are multiplied with to be seconds, degrees, metres or metres a second.
    double factor = 1.0;
    /// False where neither the name nor a line of units says so.
    bool has_unit = false;
};

/// Where a log has what; columns that are not there are empty.
struct LogColumns {
    std::array<std::optional<LogColumn>, static_cast<std::size_t>(LogQuantity::Count)> of;

    const std::optional<LogColumn>& operator[](LogQuantity what) const { return of[static_cast<std::size_t>(what)]; }
};

/// Finds the columns of a flight by their names, of which many are known, whatever their case, blanks and underscores,
/// and with a unit in brackets or at the end: "Altitude (ft)", "alt_m", "hMSL". `units`: a line of units beside the
/// names; may be empty. Altitudes without a unit are feet beside Flightradar24's columns and metres else. Nothing where
/// time, place or altitude is missing.
std::optional<LogColumns> log_columns(
    const std::vector<std::string_view>& names, const std::vector<std::string_view>& units);

} // namespace octant::flightpaths
