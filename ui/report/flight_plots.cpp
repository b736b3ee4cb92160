#include "ui/report/flight_plots.h"

#include "ui/report/flight_accumulator.h"
#include "ui/report/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace octant::ui::report {

namespace {

constexpr const char* time_label = "simulated time, s";
constexpr const char* blue = "#3b82f6";
constexpr const char* amber = "#f59e0b";
constexpr const char* green = "#10b981";
constexpr const char* violet = "#8b5cf6";
constexpr const char* grey = "#9ca3af";

PlotSeries named(PlotSeries series, const char* name, const char* colour) {
    series.name = name;
    series.colour = colour;
    return series;
}

Plot frame_time_plot(const FlightAccumulator& flight, double ceiling_ms) {
    Plot plot{"Frame time", time_label, "ms", {}, {}, 0.0, ceiling_ms};
    plot.series = {
        named(flight.warm_up_ms.series(), "warm-up", grey), named(flight.frame_ms.series(), "frame time", blue)};
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    return plot;
}

/// The least of 1, 2, 5 times a power of ten that is not below `value`.
double round_up_to_125(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= value * (1.0 - 1e-9)) { return step * power; }
    }
    return 10.0 * power;
}

Plot histogram_plot(const FrameTimeHistogram& times) {
    Plot plot{"Histogram", "frame time, ms (last bar: all above)", "frames", {}, {}, 0.7, {}};
    const Statistics statistics = times.statistics();
    if (statistics.max_ms <= 0.0) { return plot; }
    const double top_ms = std::min(statistics.max_ms, 1.6 * statistics.p99_ms);
    const double width_ms = round_up_to_125(std::max(top_ms, 1e-3) / 60.0);
    const auto last_bar = static_cast<std::size_t>(std::floor(top_ms / width_ms));
    std::vector<double> counts(last_bar + 1, 0.0);
    for (const auto& [frame_ms, frames] : times.counts()) {
        const auto bar = static_cast<std::size_t>(std::floor(std::clamp(frame_ms, 0.0, top_ms) / width_ms));
        counts[std::min(bar, last_bar)] += static_cast<double>(frames);
    }
    PlotSeries bars;
    bars.style = PlotSeries::Style::Bars;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0.0) {
            bars.x.push_back((static_cast<double>(i) + 0.5) * width_ms);
            bars.y.push_back(counts[i]);
        }
    }
    plot.series = {named(std::move(bars), "", blue)};
    plot.bar_width = 0.9 * width_ms;
    plot.y_logarithmic = true;
    return plot;
}

Plot stage_plot(const FlightAccumulator& flight, double ceiling_ms) {
    struct Stage {
        const char* name;
        const char* colour;
        double StageColumn::*duration_ms;
    };

    constexpr std::array stages{Stage{"sim", violet, &StageColumn::sim_ms}, Stage{"plan", green, &StageColumn::plan_ms},
        Stage{"draw", blue, &StageColumn::draw_ms}, Stage{"read", amber, &StageColumn::read_ms}};
    const std::vector<StageColumn>& columns = flight.stages.pieces();
    Plot plot{"Stages, stacked", time_label, "ms", {}, {}, 0.0, ceiling_ms};
    if (flight.stages.is_thinned()) { plot.x_label = "simulated time, s (columns show the longest of their frames)"; }
    std::vector<double> base(2 * columns.size(), 0.0);
    for (const Stage& stage : stages) {
        PlotSeries area = named({}, stage.name, stage.colour);
        area.style = PlotSeries::Style::Area;
        area.y_low = base;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            base[2 * i] += columns[i].*stage.duration_ms;
            base[2 * i + 1] = base[2 * i];
            const bool last = i + 1 == columns.size();
            area.x.insert(area.x.end(), {columns[i].x_s, last ? flight.end_s() : columns[i + 1].x_s});
        }
        area.y = base;
        plot.series.push_back(std::move(area));
    }
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    return plot;
}

Plot triangle_plot(const Curve& triangles) {
    Plot plot{"Terrain triangles", time_label, "triangles", {}, {}, 0.0, {}};
    plot.series = {named(triangles.series(), "", green)};
    return plot;
}

Plot change_plot(const Curve& triangle_change) {
    Plot plot{"Change of terrain triangles from frame to frame", time_label, "triangles", {}, {}, {}, {}};
    plot.series = {named(triangle_change.series(), "", violet)};
    return plot;
}

Plot target_plot(const Curve& triangle_target) {
    Plot plot{"Triangle target", time_label, "triangles", {}, {}, 0.0, {}};
    plot.series = {named(triangle_target.series(), "", amber)};
    return plot;
}

Plot stress_plot(const Curve& stress) {
    Plot plot{"Stress", time_label, "share of the frame", {}, {}, 0.0, {}};
    plot.series = {named(stress.series(), "", blue)};
    plot.levels = {{"whole frame", 1.0}};
    return plot;
}

} // namespace

double plot_ceiling_ms(const Statistics& statistics) {
    constexpr double room_for_level_ms = 18.0; // for the line of 16.67 ms
    const double needed_ms = std::min(statistics.max_ms, 2.5 * statistics.p99_ms);
    const bool is_far_below = needed_ms > 0.0 && needed_ms < room_for_level_ms / 4.0;
    return 1.05 * (is_far_below ? needed_ms : std::max(room_for_level_ms, needed_ms));
}

std::vector<Plot> flight_plots(const FlightAccumulator& flight, double ceiling_ms) {
    std::vector<Plot> plots = {frame_time_plot(flight, ceiling_ms), histogram_plot(flight.times()),
        stage_plot(flight, ceiling_ms), triangle_plot(flight.triangles), change_plot(flight.triangle_change)};
    if (flight.triangle_targets().varies()) {
        plots.push_back(target_plot(flight.triangle_target));
        plots.push_back(stress_plot(flight.stress));
    }
    return plots;
}

} // namespace octant::ui::report
