#pragma once

#include <optional>
#include <string_view>

namespace octant::flightpaths {

/// A moment as a log gives it.
struct LogTime {
    double seconds = 0.0;
    /// Seconds since midnight, which begin anew each day; else since whatever the log counts from.
    bool is_time_of_day = false;
};

/// Reads a number (as seconds), a clock (07:41:03.5) or a date with a clock, whose parts may be separated by anything
/// but digits and whose zone is passed over (2024-01-02T07:41:03Z, 2024/01/02 07:41:03+01:00). Dates count from 1970.
/// Nothing for anything else.
std::optional<LogTime> log_time(std::string_view text);

} // namespace octant::flightpaths
