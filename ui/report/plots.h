#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::report {

/// One set of points of a plot.
struct PlotSeries {
    enum class Style {
        Line,
        Area, ///< filled between `y_low` and `y`
        Bars  ///< from the axis up to `y`
    };

    std::string name;   ///< in the key; empty = not there
    std::string colour; ///< "#rrggbb"
    Style style = Style::Line;
    std::vector<double> x;
    std::vector<double> y; ///< as many as `x`; what is not finite is a gap
    std::vector<double> y_low = {};
    bool points = false; ///< Of a line: each point is marked; by gnuplot only.
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
    std::vector<PlotSeries> series; ///< drawn in this order
    std::vector<PlotReferenceLine> levels;
    std::optional<double> y_min;
    std::optional<double> y_max;
    bool y_logarithmic = false;
    double bar_width = 1.0;
    int width_px = 860;
    int height_px = 260;
    std::vector<PlotMark> marks = {}; ///< in pages only, as the ends of the x axis
    std::optional<double> x_min = {};
    std::optional<double> x_max = {};
    bool x_logarithmic = false; ///< by gnuplot only
};

/// What gnuplot is told, data included. Same plot, same text.
std::string gnuplot_script(const Plot& plot);

/// The same for a PNG picture of plots one below the other, each under its title.
std::string gnuplot_png_script(std::span<const Plot> panels);

/// The plot as an SVG document, drawn by gnuplot found on PATH; nothing when it is not installed or the plot has no
/// points. Throws Error with gnuplot's last line when it fails.
std::optional<std::string> plot_svg(const Plot& plot);

/// Plots one below the other, each under its title and with at least one point, as the bytes of a PNG file; nothing
/// when gnuplot is not installed. Throws Error with gnuplot's last line when it fails.
std::optional<std::string> plots_png(std::span<const Plot> panels);

} // namespace octant::ui::report
