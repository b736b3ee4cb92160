#pragma once

#include "ui/studies/flicker/study_options.h"

namespace octant::ui::studies::flicker {

/// What E. K. Choi and B. S. Shin show about holding the number of triangles, over a gentle and a
/// rugged field: fixed view for c = 1, 2, 3, 5, a path at c = 5, damping over r, and settling from
/// any C at gains to 5, for the paper's controls, the exact budget and the default mesh; then the
/// controls over grounds from flats to high mountains. Prints the tables and writes them to `out`
/// as CSV and together as Markdown, dn of each frame of the path as CSV, and the paper's figures as
/// PNG. The same options give the same bytes. Throws Error.
void study_flicker(const FlickerStudyOptions& options);

} // namespace octant::ui::studies::flicker
