#pragma once

#include "ui/report/html_text.h"
#include "ui/studies/flicker/flicker_figures.h"

#include <string>
#include <vector>

namespace octant::ui::studies::flicker {

struct NamedTable {
    std::string file; ///< without folder and ending
    report::HtmlTable table;
};

/// Fixed views, the path, damping over r and settling times.
std::vector<NamedTable> flicker_tables(const FlickerRuns& runs);

} // namespace octant::ui::studies::flicker
