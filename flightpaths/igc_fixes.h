#pragma once

#include "flightpaths/log_table.h"

#include <span>
#include <string_view>

namespace octant::flightpaths {

/// True for the lines of a glider's flight recorder: the first that holds anything is the record of
/// its maker (A) or of its head (H), and one is a fix.
bool is_igc(std::span<const std::string_view> lines);

/// The fixes (B records) of a flight recorder's file, as the FAI's "Technical Specification for
/// GNSS Flight Recorders", appendix A, lays them out. Heights are those of the receiver where most
/// fixes have one, else pressure altitudes; a fix without it has none. B records that are damaged
/// are rows without a place.
LogTable igc_fixes(std::span<const std::string_view> lines);

} // namespace octant::flightpaths
