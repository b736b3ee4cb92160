#pragma once

#include <string_view>

namespace octant::ui::report {

/// The style sheet of every page: light or dark as the reader's system is, fit for paper.
std::string_view page_style();

} // namespace octant::ui::report
