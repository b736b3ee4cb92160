#pragma once

#include <string_view>

namespace octant::ui::report {

/// What draws a page's plots, with values under the pointer and zoom by dragging, and sorts its tables. Refers to
/// nothing outside the page.
std::string_view page_script();

} // namespace octant::ui::report
