#pragma once

#include "ui/base/study_output.h"

namespace octant::ui::studies::draw_order {

struct DrawOrderStudyOptions : base::StudyOutput {};

/// Repeats tables 1 and 4 of the 1989 paper (frame rates; the eight orders of its example object) next to our results.
/// Then compares the ordering methods for F-15, 500MD and the example: number of cells, lists and splits, share of
/// wrong pixels by distance, and the cost of a BSP tree for the same models. Prints the tables and writes them to `out`
/// as CSV and as one Markdown page. Throws Error.
void study_draw_order(const DrawOrderStudyOptions& options);

} // namespace octant::ui::studies::draw_order
