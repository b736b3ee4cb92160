#pragma once

#include "ui/report/html_text.h"
#include "ui/studies/flicker/study_popping.h"

namespace octant::ui::studies::flicker {

/// A row a path and one for all: mean change of reprojected pixels for one and four samples a
/// pixel, geomorphs off and on. Draws. Throws Error.
report::HtmlTable shimmer_table(const PoppingStudyOptions& options);

} // namespace octant::ui::studies::flicker
