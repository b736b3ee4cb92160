#pragma once

#include "ui/report/plots.h"

#include <string>

namespace octant::ui::report {

/// How a plot stands in a page.
enum class PlotPlace {
    Half, ///< one of two beside each other
    Wide, ///< over the page's whole width
    Small ///< one of many; without the names of its axes
};

/// A plot for a page: its title, key and numbers, which page_script() draws at the size that it
/// finds. Numbers have four significant digits.
std::string page_plot(const Plot& plot, PlotPlace place);

} // namespace octant::ui::report
