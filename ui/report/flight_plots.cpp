#include "ui/report/flight_plots.h"

#include "ui/report/frame_times.h"
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

/// Most pieces that a curve is cut into: more than there are pixels.
constexpr std::size_t most_pieces = 900;

/// First index of each piece when `count` things are cut into at most `pieces`, and `count`.
std::vector<std::size_t> cuts(std::size_t count, std::size_t pieces) {
    const std::size_t used = std::min(count, pieces);
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i <= used && used > 0; ++i) {
        at.push_back(i * count / used);
    }
    return at;
}

std::vector<FrameRecord> chosen_by_warm_up(std::span<const FrameRecord> records, bool warm_up) {
    std::vector<FrameRecord> chosen;
    std::copy_if(
        records.begin(), records.end(), std::back_inserter(chosen), [&](const FrameRecord& each) {
            return each.warm_up == warm_up;
        });
    return chosen;
}

/// A curve of one value of the counted or of the warm-up frames. Where pieces hold several frames,
/// each gives its least and its greatest value in the order they came.
template <class Value>
PlotSeries curve(
    std::span<const FrameRecord> records,
    bool warm_up,
    Value value_of,
    std::size_t pieces = most_pieces) {
    const std::vector<FrameRecord> chosen = chosen_by_warm_up(records, warm_up);
    PlotSeries series;
    const auto add = [&](const FrameRecord& record) {
        series.x.push_back(record.sim_time_s);
        series.y.push_back(static_cast<double>(value_of(record)));
    };
    const auto at = cuts(chosen.size(), pieces);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const auto less = [&](const FrameRecord& a, const FrameRecord& b) {
            return value_of(a) < value_of(b);
        };
        const auto first = chosen.begin() + static_cast<std::ptrdiff_t>(at[i]);
        const auto last = chosen.begin() + static_cast<std::ptrdiff_t>(at[i + 1]);
        const auto [least, greatest] = std::minmax_element(first, last, less);
        add(*std::min(least, greatest));
        if (least != greatest) {
            add(*std::max(least, greatest));
        }
    }
    return series;
}

PlotSeries named(PlotSeries series, const char* name, const char* colour) {
    series.name = name;
    series.colour = colour;
    return series;
}

Plot frame_time_plot(std::span<const FrameRecord> records, double ceiling_ms) {
    const auto frame_ms = [](const FrameRecord& record) { return record.frame_ms; };
    Plot plot{"Frame time", time_label, "ms", {}, {}, 0.0, ceiling_ms};
    plot.series = {
        named(curve(records, true, frame_ms), "warm-up", grey),
        named(curve(records, false, frame_ms), "frame time", blue)};
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    return plot;
}

/// The least of 1, 2, 5 times a power of ten that is not below `value`.
double round_up_to_125(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= value * (1.0 - 1e-9)) {
            return step * power;
        }
    }
    return 10.0 * power;
}

Plot histogram_plot(std::span<const FrameRecord> records) {
    Plot plot{"Histogram", "frame time, ms (last bar: all above)", "frames", {}, {}, 0.7, {}};
    const Statistics statistics = statistics_of(records);
    if (statistics.max_ms <= 0.0) {
        return plot;
    }
    const double top_ms = std::min(statistics.max_ms, 1.6 * statistics.p99_ms);
    const double width_ms = round_up_to_125(std::max(top_ms, 1e-3) / 60.0);
    const auto last_bar = static_cast<std::size_t>(std::floor(top_ms / width_ms));
    std::vector<double> counts(last_bar + 1, 0.0);
    for (const FrameRecord& record : records) {
        if (!record.warm_up) {
            const auto bar = static_cast<std::size_t>(
                std::floor(std::clamp(record.frame_ms, 0.0, top_ms) / width_ms));
            counts[std::min(bar, last_bar)] += 1.0;
        }
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

/// A column of the stage plot: the longest of some frames in a row.
struct PlotColumn {
    FrameRecord longest;
    double x_from = 0.0;
    double x_to = 0.0;
};

std::vector<PlotColumn> stage_columns(std::span<const FrameRecord> counted) {
    constexpr std::size_t most_columns = 400; // each wide enough to be seen
    std::vector<PlotColumn> columns;
    const auto at = cuts(counted.size(), most_columns);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const auto piece = counted.subspan(at[i], at[i + 1] - at[i]);
        const auto longest =
            std::max_element(piece.begin(), piece.end(), [](const auto& a, const auto& b) {
                return a.frame_ms < b.frame_ms;
            });
        const double to_s =
            at[i + 1] < counted.size() ? counted[at[i + 1]].sim_time_s : piece.back().sim_time_s;
        columns.push_back({*longest, piece.front().sim_time_s, to_s});
    }
    return columns;
}

Plot stage_plot(std::span<const FrameRecord> records, double ceiling_ms) {
    struct Stage {
        const char* name;
        const char* colour;
        double FrameRecord::*duration_ms;
    };

    constexpr std::array stages{
        Stage{"sim", violet, &FrameRecord::sim_ms},
        Stage{"plan", green, &FrameRecord::plan_ms},
        Stage{"draw", blue, &FrameRecord::draw_ms},
        Stage{"read", amber, &FrameRecord::read_ms}};
    const std::vector<FrameRecord> counted = chosen_by_warm_up(records, false);
    const std::vector<PlotColumn> columns = stage_columns(counted);
    Plot plot{"Stages, stacked", time_label, "ms", {}, {}, 0.0, ceiling_ms};
    if (columns.size() < counted.size()) {
        plot.x_label = "simulated time, s (columns show the longest of their frames)";
    }
    std::vector<double> base(2 * columns.size(), 0.0);
    for (const Stage& stage : stages) {
        PlotSeries area = named({}, stage.name, stage.colour);
        area.style = PlotSeries::Style::Area;
        area.y_low = base;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            base[2 * i] += columns[i].longest.*stage.duration_ms;
            base[2 * i + 1] = base[2 * i];
            area.x.insert(area.x.end(), {columns[i].x_from, columns[i].x_to});
        }
        area.y = base;
        plot.series.push_back(std::move(area));
    }
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    return plot;
}

Plot triangle_plot(std::span<const FrameRecord> records) {
    Plot plot{"Terrain triangles", time_label, "triangles", {}, {}, 0.0, {}};
    plot.series = {named(
        curve(records, false, [](const FrameRecord& record) { return record.terrain_triangles; }),
        "",
        green)};
    return plot;
}

Plot change_plot(std::span<const FrameRecord> records) {
    Plot plot{
        "Change of terrain triangles from frame to frame", time_label, "triangles", {}, {}, {}, {}};
    plot.series = {named(
        curve(records, false, [](const FrameRecord& record) { return record.triangle_change; }),
        "",
        violet)};
    return plot;
}

Plot target_plot(std::span<const FrameRecord> records) {
    Plot plot{"Triangle target", time_label, "triangles", {}, {}, 0.0, {}};
    plot.series = {named(
        curve(records, false, [](const FrameRecord& record) { return record.triangle_target; }),
        "",
        amber)};
    return plot;
}

Plot stress_plot(std::span<const FrameRecord> records) {
    Plot plot{"Stress", time_label, "share of the frame", {}, {}, 0.0, {}};
    plot.series = {named(
        curve(records, false, [](const FrameRecord& record) { return record.stress; }), "", blue)};
    plot.levels = {{"whole frame", 1.0}};
    return plot;
}

} // namespace

PlotSeries frame_time_curve(std::span<const FrameRecord> records, std::size_t pieces) {
    return curve(
        records, false, [](const FrameRecord& record) { return record.frame_ms; }, pieces);
}

TargetRange triangle_targets_of(std::span<const FrameRecord> records) {
    TargetRange range;
    double sum = 0.0;
    int frames = 0;
    for (const FrameRecord& record : records) {
        if (!record.warm_up) {
            const int target = record.triangle_target;
            range.least = frames > 0 ? std::min(range.least, target) : target;
            range.greatest = std::max(range.greatest, target);
            sum += target;
            ++frames;
        }
    }
    range.mean = frames > 0 ? sum / frames : 0.0;
    return range;
}

double plot_ceiling_ms(std::span<const FrameRecord> records) {
    const Statistics statistics = statistics_of(records);
    return 1.05 * std::max(18.0, std::min(statistics.max_ms, 2.5 * statistics.p99_ms));
}

std::vector<Plot> flight_plots(std::span<const FrameRecord> records, double ceiling_ms) {
    std::vector<Plot> plots = {
        frame_time_plot(records, ceiling_ms),
        histogram_plot(records),
        stage_plot(records, ceiling_ms),
        triangle_plot(records),
        change_plot(records)};
    if (triangle_targets_of(records).moved()) {
        plots.push_back(target_plot(records));
        plots.push_back(stress_plot(records));
    }
    return plots;
}

} // namespace octant::ui::report
