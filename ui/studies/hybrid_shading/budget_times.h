#pragma once

#include "ui/report/html_text.h"

#include <span>
#include <string>

namespace octant::ui::studies::hybrid_shading {

/// What `--adapt shading` makes of budgets below, between and above the times that all flat and all
/// Gouraud take, by the raster renderer: three flights draw every frame in turn, so that they see
/// the same machine. These times are the machine's, not the same twice. `aircraft`: as --aircraft.
/// Throws Error.
report::HtmlTable budget_times_table(std::span<const std::string> aircraft, bool quiet);

} // namespace octant::ui::studies::hybrid_shading
