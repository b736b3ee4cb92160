#pragma once

#include "sim/base/error.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Tables of flights as text: fields of a line, times, and columns by name.

namespace octant::flightpaths {

/// True for 0 to 9.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns the field separator of a table, found from its line of column names: a tab if the line has one; else a
/// semicolon if the line has one and no comma; else a comma.
char separator_of(std::string_view column_names);

/// Splits a line into fields. Blanks and one pair of double quotes around a field are removed; a separator between
/// quotes does not split. The fields are views of the line.
std::vector<std::string_view> unquoted_fields(std::string_view line, char separator);

/// True when every field is empty.
bool are_empty(std::span<const std::string_view> fields);

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

/// The quantities of a track of Octant or JSBSim. The unit of a value is the unit in the column's name.
enum TrackQuantity {
    Time,
    North,
    East,
    Altitude,
    Roll,
    Pitch,
    Yaw,
    NorthSpeed,
    EastSpeed,
    UpSpeed,
    LoadFactor,
    QuaternionW,
    QuaternionX,
    QuaternionY,
    QuaternionZ,
    QuantityCount
};

/// JSBSim's name of the geocentric latitude; its geodetic latitude has a column of its own.
inline constexpr std::string_view geocentric_latitude = "Latitude (deg)";

struct TrackColumn {
    /// Index of the field in a line; negative if the track has no such column.
    int field = -1;
    std::string_view name;
};

/// The columns of a track of Octant or JSBSim.
struct TrackHeader {
    char separator = ',';
    bool is_jsbsim = false;
    /// Number of fields in the line of column names.
    std::size_t fields = 0;
    std::array<TrackColumn, QuantityCount> columns;

    bool has(std::initializer_list<TrackQuantity> quantities) const {
        for (const TrackQuantity quantity : quantities) {
            if (columns[quantity].field < 0) { return false; }
        }
        return true;
    }
};

/// The line of a file to which an error message refers.
struct TrackLineLocation {
    const std::filesystem::path& file;
    int line;

    [[noreturn]] void refuse(const std::string& what) const { throw_error_at(file, line, what); }
};

/// True if the names contain the time, north (or latitude), east (or longitude) and altitude columns of Octant or of
/// JSBSim.
bool are_track_columns(const std::vector<std::string_view>& names);

/// Finds the columns of a track of Octant or JSBSim in its line of column names; upper and lower case are equal. Throws
/// Error if a required column is missing or occurs twice.
TrackHeader track_header(std::string_view line, const TrackLineLocation& at);

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
