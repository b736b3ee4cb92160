#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Times and columns of flight logs that other programs write.

namespace octant::flightpaths {

/// True for 0 to 9.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A time as a log writes it.
struct LogTime {
    double seconds = 0.0;
    /// True: `seconds` counts from midnight and restarts every day. False: it counts from an origin that the log chose.
    bool is_time_of_day = false;
};

/// Reads a number (seconds), a time of day (07:41:03.5) or a date with a time of day (2024-01-02T07:41:03Z, 2024/01/02
/// 07:41:03+01:00). Any single character may separate the parts of a date. A time zone is accepted and ignored. Dates
/// become seconds since 1970. Returns nothing for any other text.
std::optional<LogTime> log_time(std::string_view text);

/// The quantities of a log of another program.
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
    /// The column's name as the log writes it.
    std::string name;
    /// Factor from the log's unit to seconds, degrees, metres or metres per second.
    double factor = 1.0;
    /// True if the column's name or the line of units gives the unit.
    bool has_unit = false;
};

/// The columns of a log; a quantity without a column is empty.
struct LogColumns {
    std::array<std::optional<LogColumn>, static_cast<std::size_t>(LogQuantity::Count)> of;

    const std::optional<LogColumn>& operator[](LogQuantity what) const { return of[static_cast<std::size_t>(what)]; }
};

/// Finds the columns of a log by a table of known names. Case, blanks and underscores do not matter. A unit may stand
/// in brackets or at the end of a name: "Altitude (ft)", "alt_m", "hMSL". `units` is the log's line of units, one per
/// name; it may be empty. An altitude without a unit is in feet in a Flightradar24 log and in metres in any other.
/// Returns nothing if time, position or altitude is missing.
std::optional<LogColumns> log_columns(
    const std::vector<std::string_view>& names, const std::vector<std::string_view>& units);

} // namespace octant::flightpaths
