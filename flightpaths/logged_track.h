#pragma once

#include "flightpaths/log_columns.h"
#include "sim/aircraft_state.h"
#include "sim/base/geo_position.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// The text of a log, cut into lines.
struct LogText {
    const std::filesystem::path& file;
    std::span<const std::string_view> lines;
    /// The last line before the samples, from 0: that of the columns' names or their units.
    std::size_t header_line = 0;
    char separator = ',';
    /// Which line of the file each of these is, from 1; empty: they are all of its lines.
    std::span<const int> numbers = {};
};

struct LoggedTrack {
    /// At least 2, in the axes of a TransverseMercator frame at `origin`, heights above datum.
    std::vector<sim::AircraftState> samples;
    GeoPosition origin;
    /// What a person should be told of it.
    std::vector<std::string> notes;
};

/// Reads another program's log of a flight (log_columns.h), whose lines are less regular than those
/// of a recording: lines without time, place or height, of a moment that has been, or that only a
/// jump faster than 3000 m/s leads to are left out and counted in the notes. Times begin at 0.
/// Attitudes are the log's where it has roll and pitch in every line, with its true heading or else
/// that of the motion; otherwise they are made from the motion. Throws Error with file and line for
/// what is neither empty nor a number where there must be one, a place that is on no earth, more
/// than a day, and fewer than 2 samples.
LoggedTrack logged_track(const LogText& log, const LogColumns& columns);

} // namespace octant::flightpaths
