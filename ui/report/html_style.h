#pragma once

#include <string>
#include <string_view>

namespace octant::ui::report {

/// The style sheet of every page: light or dark as the reader's system is, fit for paper.
std::string_view page_style();

/// The beginning of every page, up to its opened main element; `layout`: "one" or "several" as the style sheet has
/// them.
std::string page_head(std::string_view title, std::string_view layout);

} // namespace octant::ui::report
