#pragma once

#include "flightpaths/log_table.h"

#include <filesystem>
#include <string_view>

namespace octant::flightpaths {

/// True for a text whose root element is GPX's.
bool is_gpx(std::string_view text);

/// The track points of a GPX file (topografix.com/GPX/1/1), of all its tracks and segments in their
/// order; waypoints and routes have no times and are passed over. Throws Error with file and line
/// for a comment or a track point without an end, and with the file where there is no track point.
LogTable gpx_points(const std::filesystem::path& file, std::string_view text);

} // namespace octant::flightpaths
