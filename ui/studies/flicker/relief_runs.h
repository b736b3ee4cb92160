#pragma once

#include "ui/report/html_text.h"
#include "ui/studies/flicker/study_options.h"

namespace octant::ui::studies::flicker {

/// How quietly the damped control as printed, the one that finds its own gain and the exact budget
/// hold the count over grounds of all reliefs: two made ones flatter than `options.gentle`, that
/// and `options.rugged`, and a made one as high as the Himalaya. A row for each ground and control:
/// loop gain, mean change of N over the last frames of a fixed view and along the path. Throws
/// Error.
report::HtmlTable relief_table(const FlickerStudyOptions& options);

} // namespace octant::ui::studies::flicker
