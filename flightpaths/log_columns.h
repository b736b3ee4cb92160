#pragma once

#include "flightpaths/track_recording.h"

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

/// Capitals of ASCII become small letters.
std::string in_small_letters(std::string_view text);

/// A time as a log writes it.
struct LogTime {
    double seconds = 0.0;
    /// True: `seconds` counts from midnight and restarts every day. False: it counts from an origin that the log chose.
    bool is_time_of_day = false;
    /// True: `seconds` counts from 1970, UTC.
    bool is_date = false;
    /// True for the second 60 of a minute, which has the number of the next second.
    bool is_leap_second = false;
    /// True for a date whose month and day could be exchanged (3/5/2024): the first number is taken as the month.
    bool day_is_guessed = false;
};

/// Reads a number (seconds), a time of day (07:41:03.5, 7:41:03 PM) or a date with a time of day (2024-01-02T07:41:03Z,
/// 2024/01/02 07:41:03+01:00). Any single character may separate the parts of a date. A date may end with its year
/// (1/31/2024, 31/1/2024, 31.1.2024). Dates become seconds since 1970, UTC; a date without a time zone is taken as UTC.
/// The time zone of a time of day is ignored. Returns nothing for any other text.
std::optional<LogTime> log_time(std::string_view text);

/// Reads a date without a time (2024-01-02, 1/2/2024, 20240102). Returns nothing for any other text.
std::optional<LogTime> log_date(std::string_view text);

/// Reads an offset from UTC (-04:00, +0530, Z): seconds. Returns nothing for any other text.
std::optional<double> zone_offset_s(std::string_view text);

/// The quantities of a log of another program.
enum class LogQuantity {
    Time,
    /// A second column of times, with dates.
    Clock,
    Date,
    UtcOffset,
    Latitude,
    Longitude,
    NorthSouth,
    EastWest,
    /// Latitude and longitude in one field, separated by a comma.
    Position,
    Altitude,
    PressureAltitude,
    Roll,
    Pitch,
    Heading,
    MagneticHeading,
    Track,
    GroundSpeed,
    Climb,
    TrueAirspeed,
    NorthSpeed,
    EastSpeed,
    DownSpeed,
    LoadFactor,
    HorizontalError,
    VerticalError,
    OnGround,
    Id,
    CallSign,
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
    HeightKind heights = HeightKind::Unknown;

    const std::optional<LogColumn>& operator[](LogQuantity what) const { return of[static_cast<std::size_t>(what)]; }
};

/// Finds the columns of a log by a table of known names. Case, blanks and underscores do not matter. A unit may stand
/// in brackets or at the end of a name: "Altitude (ft)", "alt_m", "hMSL". `units` is the log's line of units, one per
/// name; it may be empty. An altitude without a unit is in feet in a Flightradar24 log and in metres in any other. A
/// vertical speed without a unit is ignored but for OpenSky's vertrate. Returns nothing if time or position is missing.
std::optional<LogColumns> log_columns(
    const std::vector<std::string_view>& names, const std::vector<std::string_view>& units);

} // namespace octant::flightpaths
