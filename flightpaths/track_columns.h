#pragma once

#include "sim/base/error.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// What a column means; the value of each column is in the unit of its name.
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

/// What JSBSim calls so is geocentric.
inline constexpr std::string_view geocentric_latitude = "Latitude (deg)";

struct TrackColumn {
    /// Negative = it is not there.
    int field = -1;
    std::string_view name;
};

/// Where a track of our own or of JSBSim has what.
struct TrackHeader {
    char separator = ',';
    bool is_jsbsim = false;
    std::size_t fields = 0;
    std::array<TrackColumn, QuantityCount> columns;

    bool has(std::initializer_list<TrackQuantity> quantities) const {
        for (const TrackQuantity quantity : quantities) {
            if (columns[quantity].field < 0) { return false; }
        }
        return true;
    }
};

/// A line of a file, for messages.
struct TrackLineLocation {
    const std::filesystem::path& file;
    int line;

    [[noreturn]] void refuse(const std::string& what) const { throw_error_at(file, line, what); }
};

/// Whether these are names of columns as we or JSBSim write them, with a time and a place among them.
bool are_track_columns(const std::vector<std::string_view>& names);

/// Finds the columns of a track in a line of their names, whatever their case. Throws Error for a missing or doubled
/// column.
TrackHeader track_header(std::string_view line, const TrackLineLocation& at);

} // namespace octant::flightpaths
