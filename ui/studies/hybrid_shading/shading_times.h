#pragma once

#include "ui/report/table.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

/// Frame times of aircraft flown with all polygons flat, all smooth, and shares between, frame by frame beside each
/// other: medians. These times are the machine's, not the same twice. `aircraft`: as --aircraft. Throws Error.
report::ResultTable shading_times_table(std::span<const std::string> aircraft, bool quiet);

} // namespace octant::ui::studies::hybrid_shading
