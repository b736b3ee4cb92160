#pragma once

#include "ui/base/study_output.h"

namespace octant::ui::studies::draw_order {

struct DrawOrderStudyOptions : base::StudyOutput {};

/// Table 4 of the 1989 paper (the eight orders of its example object) with ours beside, and what the paper leaves open,
/// for F-15, 500MD and the example: how many cells, lists and splits each way of ordering needs, how many pixels each
/// paints wrongly by distance, and what a BSP tree needs for the same. Prints the tables and writes them to `out` as
/// CSV and together as Markdown. Throws Error.
void study_draw_order(const DrawOrderStudyOptions& options);

} // namespace octant::ui::studies::draw_order
