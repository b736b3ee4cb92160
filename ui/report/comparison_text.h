#pragma once

#include "ui/report/loaded_recording.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// Of curves in one plot, as HTML has them.
inline constexpr std::array run_colours{
    "#3b82f6",
    "#f59e0b",
    "#10b981",
    "#ef4444",
    "#8b5cf6",
    "#14b8a6",
    "#ec4899",
    "#84cc16",
    "#6366f1",
    "#a16207"};

/// What tells a recording from the others: its folder's name, or its whole path where names repeat.
std::string label_of(Recordings recordings, const LoadedRecording& recording);

/// The value of a name; empty where there is none.
std::string value_of(const NamedValues& rows, std::string_view name);

/// Names of settings in which some of these recordings differ, in their order. `among`: at least
/// one number of a recording.
std::vector<std::string>
differing_settings(Recordings recordings, const std::vector<std::size_t>& among);

/// A file's name without its folder, as table cells have room for; any other text as it is.
std::string short_value(const std::string& value);

/// A cell of a table, as HTML.
std::string number_cell(double value, int decimals);

/// The figure of that key, which there must be.
const Statistic& statistic_named(std::string_view key);

/// Where the axis of frame times ends, of all these recordings, milliseconds.
double shared_ceiling_ms(Recordings recordings, const std::vector<std::size_t>& runs);

} // namespace octant::ui::report
