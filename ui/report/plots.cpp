#include "ui/report/plots.h"

#include "sim/base/error.h"
#include "sim/base/format_once.h"
#include "ui/report/child_program.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <utility>

namespace octant::ui::report {

namespace {

using Out = std::back_insert_iterator<std::string>;

/// A text for gnuplot: single quotes, in which only the quote itself is special.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') {
            out += "''";
        } else {
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return out + "'";
}

void append_data(Out out, std::size_t index, const PlotSeries& series) {
    const bool area = series.style == PlotSeries::Style::Area;
    assert(series.y.size() == series.x.size());
    assert(!area || series.y_low.size() == series.x.size());
    fmt::format_to(out, "$series{} << EOD\n", index);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) {
            fmt::format_to(out, "\n");
        } else if (area) {
            fmt::format_to(out, "{:.7g} {:.7g} {:.7g}\n", series.x[i], series.y_low[i], series.y[i]);
        } else {
            fmt::format_to(out, "{:.7g} {:.7g}\n", series.x[i], series.y[i]);
        }
    }
    fmt::format_to(out, "EOD\n");
}

std::string series_clause(std::size_t index, const PlotSeries& series) {
    const std::string title = series.name.empty() ? std::string("notitle") : "title " + quoted(series.name);
    switch (series.style) {
    case PlotSeries::Style::Area:
        return fmt::format("$series{} using 1:2:3 with filledcurves lc rgb {} {}", index, quoted(series.colour), title);
    case PlotSeries::Style::Bars:
        return fmt::format("$series{} using 1:2 with boxes lc rgb {} {}", index, quoted(series.colour), title);
    case PlotSeries::Style::Line:
        break;
    }
    return fmt::format("$series{} using 1:2 with {} lw 1.2 lc rgb {} {}", index,
        series.points ? "linespoints pt 7 ps 0.6" : "lines", quoted(series.colour), title);
}

bool has_points(const PlotSeries& series) {
    const auto finite = [](double value) { return std::isfinite(value); };
    return std::any_of(series.y.begin(), series.y.end(), finite);
}

std::string bound(const std::optional<double>& value) { return value ? fmt::format("{:.7g}", *value) : "*"; }

void append_axes(Out out, const Plot& plot) {
    fmt::format_to(out,
        "set encoding utf8\nset border 3 lw 0.8\nset tics nomirror out scale 0.6\nset grid y\n"
        "set key above right horizontal samplen 1.5 noenhanced\n"
        "set style fill solid 0.85 noborder\nset boxwidth {:.7g}\n",
        plot.bar_width);
    fmt::format_to(out, "set xlabel {}\nset ylabel {}\nset autoscale xfix\nset yrange [{}:{}]\n", quoted(plot.x_label),
        quoted(plot.y_label), bound(plot.y_min), bound(plot.y_max));
    if (plot.x_logarithmic) { fmt::format_to(out, "set logscale x\n"); }
    if (plot.y_logarithmic) { fmt::format_to(out, "set logscale y\n"); }
}

/// All of a plot but the terminal.
std::string axes_and_data(const Plot& plot) {
    std::string script;
    const Out out(script);
    append_axes(out, plot);
    std::string clauses;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        if (has_points(plot.series[i])) {
            append_data(out, i, plot.series[i]);
            clauses += (clauses.empty() ? "" : ", ") + series_clause(i, plot.series[i]);
        }
    }
    for (const PlotReferenceLine& level : plot.levels) {
        clauses += fmt::format("{}{:.7g} with lines dt 2 lw 1 lc rgb '#ef4444' title {}", clauses.empty() ? "" : ", ",
            level.y, quoted(level.name));
    }
    return script + "plot " + clauses + "\n";
}

/// What gnuplot makes of a script; `end`: stands in every whole picture. Nothing when it is not installed.
std::optional<std::string> draw_with_gnuplot(const std::string& script, std::string_view end) {
    auto gnuplot = ChildProgram::start({"gnuplot", "--default-settings", "-"});
    if (!gnuplot) { return std::nullopt; }
    gnuplot->send(script);
    ProgramResult ending = gnuplot->finish();
    if (!ending.succeeded || ending.output.find(end) == std::string::npos) {
        throw Error("gnuplot: " + printable(ending.last_error_line));
    }
    return std::move(ending.output);
}

} // namespace

std::string gnuplot_script(const Plot& plot) {
    return fmt::format("set terminal svg size {},{} noenhanced font 'sans-serif,12'\n", plot.width_px, plot.height_px) +
           axes_and_data(plot);
}

std::string gnuplot_png_script(std::span<const Plot> panels) {
    int width_px = 0;
    int height_px = 0;
    std::string body;
    for (const Plot& plot : panels) {
        width_px = std::max(width_px, plot.width_px);
        height_px += plot.height_px;
        body += fmt::format("set title {} noenhanced\n", quoted(plot.title)) + axes_and_data(plot) + "unset logscale\n";
    }
    return fmt::format("set terminal pngcairo size {},{} noenhanced font 'sans-serif,10'\n"
                       "set multiplot layout {},1\n",
               width_px, height_px, panels.size()) +
           body + "unset multiplot\n";
}

std::optional<std::string> plot_svg(const Plot& plot) {
    if (std::none_of(plot.series.begin(), plot.series.end(), has_points)) { return std::nullopt; }
    return draw_with_gnuplot(gnuplot_script(plot), "</svg>");
}

std::optional<std::string> plots_png(std::span<const Plot> panels) {
    return draw_with_gnuplot(gnuplot_png_script(panels), "IEND");
}

} // namespace octant::ui::report
