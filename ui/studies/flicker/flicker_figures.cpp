// The paper's figures with our data.
//
// Source: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect",
// figures 3, 5, 6, 8 and 9.
// Deviations: figures 8 and 9 are called 7 and 8 in the paper's text. Figure 3 is a pair of
// pictures there; what it counts is plotted here.
#include "ui/studies/flicker/flicker_figures.h"

#include "ui/report/plots.h"
#include "visuals/terrain/count_statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace octant::ui::studies::flicker {

namespace {

constexpr std::array colours = {"#1f77b4", "#2ca02c", "#ff7f0e", "#d62728"};
constexpr const char* blue = colours[0];
constexpr const char* red = colours[3];
constexpr std::size_t shown_frames = 60; ///< of a fixed view

report::Plot frame_plot(std::string title, const char* y_label) {
    report::Plot plot;
    plot.title = std::move(title);
    plot.x_label = "frame";
    plot.y_label = y_label;
    plot.height_px = 280;
    return plot;
}

report::PlotSeries
series_of(std::string name, const char* colour, std::span<const int> values, std::size_t first) {
    report::PlotSeries series;
    series.name = std::move(name);
    series.colour = colour;
    for (std::size_t k = 0; k < values.size(); ++k) {
        series.x.push_back(static_cast<double>(first + k));
        series.y.push_back(values[k]);
    }
    return series;
}

/// dn of the first `frames` frames, from the second on.
report::PlotSeries
changes_of(std::string name, const char* colour, const FlickerRun& run, std::size_t frames) {
    std::vector<int> changes;
    for (std::size_t k = 1; k < std::min(run.triangles.size(), frames); ++k) {
        changes.push_back(run.triangles[k] - run.triangles[k - 1]);
    }
    return series_of(std::move(name), colour, changes, 1);
}

report::Plot path_plot(std::string title, const FlickerRun& run, const char* colour) {
    report::Plot plot = frame_plot(std::move(title), "dn, triangles");
    plot.series = {changes_of("", colour, run, run.triangles.size())};
    return plot;
}

/// Largest size of the values from the `first` on.
double largest(std::span<const report::Plot> plots, std::size_t first) {
    double most = 1.0;
    for (const report::Plot& plot : plots) {
        for (const report::PlotSeries& series : plot.series) {
            for (std::size_t k = first; k < series.y.size(); ++k) {
                most = std::max(most, std::abs(series.y[k]));
            }
        }
    }
    return most;
}

void set_range(std::span<report::Plot> plots, double most) {
    for (report::Plot& plot : plots) {
        plot.y_min = -1.05 * most;
        plot.y_max = 1.05 * most;
    }
}

FlickerFigure figure(std::string file, std::string caption, std::span<const report::Plot> panels) {
    return {std::move(file), std::move(caption), report::plots_png(panels).value_or("")};
}

FlickerFigure figure_3(const FieldRuns& rugged) {
    report::Plot plot = frame_plot(
        fmt::format(
            "Figure 3: fans of consecutive frames, fixed view of {}, previous control",
            rugged.name),
        "fans");
    for (const std::size_t weight : {std::size_t{2}, std::size_t{0}}) {
        const FlickerRun& run = rugged.fixed[weight][previous_control];
        plot.series.push_back(series_of(
            fmt::format("c = {:g}", flicker_weights[weight]),
            weight == 0 ? blue : red,
            std::span(run.fans).first(std::min(run.fans.size(), shown_frames)),
            0));
    }
    plot.levels = {{"paper, 5256", 5256.0}, {"paper, 2745", 2745.0}};
    plot.y_min = 0.0;
    return figure(
        "figure-3.png",
        "Fixed view of rugged ground: at large c the count of fans alternates from frame to frame "
        "for ever, at c = 1 it stands. The paper shows two such frames, of 5256 and 2745 fans.",
        std::span(&plot, 1));
}

FlickerFigure figure_5(const FlickerRuns& runs) {
    std::array plots = {
        path_plot(
            fmt::format("Figure 5 (a): previous control, c = 5, {}", runs.gentle.name),
            runs.gentle.path[previous_control],
            blue),
        path_plot(
            fmt::format("Figure 5 (b): previous control, c = 5, {}", runs.rugged.name),
            runs.rugged.path[previous_control],
            red)};
    set_range(plots, largest(plots, 0));
    return figure(
        "figure-5.png",
        "dn along the path under the previous control, on one scale. The paper: calm all the way "
        "over Puget Sound (a), violent over the Grand Canyon (b).",
        plots);
}

FlickerFigure figure_6(const FieldRuns& rugged) {
    std::array plots = {
        frame_plot(
            fmt::format("Figure 6: dn at a fixed view of {}, C + (target - N) / a", rugged.name),
            "dn, triangles"),
        frame_plot("The same with C - (N - N of the frame before) / a", "dn, triangles")};
    const std::array ways = {previous_control, literal_control};
    for (std::size_t i = 0; i < plots.size(); ++i) {
        for (std::size_t weight = flicker_weights.size(); weight-- > 0;) {
            plots[i].series.push_back(changes_of(
                fmt::format("c = {:g}", flicker_weights[weight]),
                colours[weight],
                rugged.fixed[weight][ways[i]],
                shown_frames));
        }
    }
    set_range(plots, largest(std::span(plots).first(1), 0));
    return figure(
        "figure-6.png",
        "dn at a fixed view of rugged ground for c = 1, 2, 3, 5, both readings of equation (4). "
        "The "
        "paper: c = 1 is best, c = 2 comes to rest after a weak oscillation, from c = 3 on it "
        "oscillates for ever. Beyond the scale: literal (4) runs from end to end of C.",
        plots);
}

FlickerFigure figure_8(const FieldRuns& rugged) {
    const report::Plot plot = path_plot(
        fmt::format("Figure 8: previous control, c = 5, {}", rugged.name),
        rugged.path[previous_control],
        red);
    return figure(
        "figure-8.png",
        "dn along the path before the damping. The paper: an oscillation everywhere, wide in some "
        "places.",
        std::span(&plot, 1));
}

FlickerFigure figure_9(const FieldRuns& rugged) {
    std::array plots = {
        path_plot(
            fmt::format("Figure 9: damped control, c = 5, {}, scale of figure 8", rugged.name),
            rugged.path[damped_control],
            blue),
        path_plot("The same, enlarged", rugged.path[damped_control], blue),
        path_plot("Exact budget, scale as enlarged", rugged.path[exact_control], colours[1]),
        path_plot(
            "Screen-error mesh (default), scale as enlarged", rugged.path[screen_error_control], colours[1])};
    const report::Plot before = path_plot("", rugged.path[previous_control], red);
    set_range(std::span(plots).first(1), largest(std::span(&before, 1), 0));
    const auto enlarged = std::span(plots).subspan(1);
    set_range(
        enlarged, largest(enlarged, first_measured(rugged.path[damped_control].triangles.size())));
    return figure(
        "figure-9.png",
        "dn along the path with the damping. The paper: a small ripple only, level everywhere.",
        plots);
}

FlickerFigure damping(const FlickerRuns& runs) {
    report::Plot plot = frame_plot(
        fmt::format("Damping: dn along the path over {}, c = 5", runs.rugged.name), "mean |dn|");
    plot.x_label = "r, earlier frames averaged";
    plot.y_logarithmic = true;
    report::PlotSeries mean;
    mean.colour = blue;
    mean.name = "mean |dn|";
    report::PlotSeries flicker_triangles;
    flicker_triangles.colour = red;
    flicker_triangles.name = "alternation";
    for (std::size_t k = 0; k < runs.damping_lengths.size(); ++k) {
        const auto figures = visuals::terrain::change_statistics(
            runs.damping_lengths[k].triangles, first_measured(runs.damping_lengths[k].triangles.size()));
        mean.x.push_back(damping_frame_counts[k]);
        mean.y.push_back(figures.mean);
        flicker_triangles.x.push_back(damping_frame_counts[k]);
        flicker_triangles.y.push_back(std::max(figures.flicker_triangles, 0.1));
    }
    plot.series = {mean, flicker_triangles};
    return figure(
        "damping.png",
        "Mean |dn| and alternation over the number r of earlier frames that are averaged, equation "
        "(5) as printed; r = 0 is the previous control. The paper: r = 4 is best.",
        std::span(&plot, 1));
}

} // namespace

std::size_t first_measured(std::size_t frames) {
    return std::min<std::size_t>(20, frames / 2) + 1;
}

std::vector<FlickerFigure> flicker_figures(const FlickerRuns& runs) {
    return {
        figure_3(runs.rugged),
        figure_5(runs),
        figure_6(runs.rugged),
        figure_8(runs.rugged),
        figure_9(runs.rugged),
        damping(runs)};
}

} // namespace octant::ui::studies::flicker
