#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// A log of another kind of file as rows of text, which logged_track() reads.
struct LogTable {
    /// Names of the columns first, then a row a fix: "07:41:03,47.1,8.2,512". What a fix does not
    /// tell is empty.
    std::vector<std::string> rows;
    /// The line of the file that each row comes from, counted from 1.
    std::vector<int> line_numbers;
    /// What a person should be told of it.
    std::vector<std::string> notes;
};

/// The columns of a LogTable.
inline constexpr std::string_view log_table_columns = "time,latitude,longitude,altitude_m";

} // namespace octant::flightpaths
