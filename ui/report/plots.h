#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// One set of points of a plot.
struct PlotSeries {
    enum class Style {
        Line,
        Points, ///< joined by a line
        Area,   ///< filled between `y_low` and `y`
        Bars    ///< from the axis up to `y`
    };

    std::string name;   ///< in the key; empty = not there
    std::string colour; ///< "#rrggbb"
    Style style = Style::Line;
    std::vector<double> x = {};
    std::vector<double> y = {}; ///< as many as `x`; what is not finite is a gap
    std::vector<double> y_low = {};
    /// Index in page_curves(), in place of `x` and `y`. A `name` then stands in the key for all curves that have it.
    std::optional<std::size_t> shared_curve = {};
};

/// A level line across a plot.
struct PlotReferenceLine {
    std::string name;
    double y = 0.0;
};

/// A place on the x axis that is marked from top to bottom.
struct PlotMark {
    std::string name;
    double x = 0.0;
};

struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<PlotSeries> series = {}; ///< drawn in this order
    std::vector<PlotReferenceLine> levels = {};
    std::optional<double> y_min = {};
    std::optional<double> y_max = {};
    bool y_logarithmic = false;
    double bar_width = 1.0;
    std::vector<PlotMark> marks = {};
    std::optional<double> x_min = {};
    std::optional<double> x_max = {};
    bool x_logarithmic = false;
};

/// Width of a plot in a page.
enum class PlotWidth {
    HalfWidth, ///< one of two beside each other
    FullWidth, ///< over the page's whole width
    Small      ///< one of many; without the names of its axes
};

/// Makes the HTML of a picture of a plot, for readers without script.
using PlotPicture = std::string (*)(const Plot&);

/// A plot for a page: its title, key and numbers, which the script of html_text.h draws at the size that it finds.
/// Numbers have five significant digits. Readers without script have a picture where `picture_of` is not null.
std::string page_plot(const Plot& plot, PlotWidth width, PlotPicture picture_of = nullptr);

/// Curves that plots of page_plot_list() share: their names and points, once in a page.
std::string page_curves(std::span<const PlotSeries> curves);

/// Many plots, all of whose series are among these shared curves. The script makes them while the reader scrolls, so
/// that a page of ten thousand opens at once. A plot without a title has the name of its first curve. Readers without
/// script have pictures of the first twelve, where `picture_of` is not null.
std::string page_plot_list(
    std::span<const Plot> plots, std::span<const PlotSeries> curves, PlotWidth width, PlotPicture picture_of = nullptr);

} // namespace octant::ui::report
