#pragma once

#include "ui/report/plots.h"

#include <string>

namespace octant::ui::report {

/// How a plot stands in a page.
enum class PlotWidth {
    HalfWidth, ///< one of two beside each other
    FullWidth, ///< over the page's whole width
    Small ///< one of many; without the names of its axes
};

/// A plot for a page: its title, key and numbers, which page_script() draws at the size that it
/// finds. Numbers have four significant digits.
std::string page_plot(const Plot& plot, PlotWidth place);

} // namespace octant::ui::report
