#include "ui/report/flight_accumulator.h"

#include "ui/report/statistics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace octant::ui::report {

StageColumn joined(const StageColumn& earlier, const StageColumn& later) {
    StageColumn column = later.frame_ms > earlier.frame_ms ? later : earlier;
    column.x_s = earlier.x_s;
    return column;
}

CurvePiece joined(const CurvePiece& earlier, const CurvePiece& later) {
    if (!std::isfinite(earlier.lowest.y)) { return later; }
    if (!std::isfinite(later.lowest.y)) { return earlier; }
    return {later.lowest.y < earlier.lowest.y ? later.lowest : earlier.lowest,
        later.highest.y > earlier.highest.y ? later.highest : earlier.highest};
}

std::vector<CurvePiece> Curve::thinned(std::size_t max_pieces) const {
    assert(max_pieces >= 1);
    const std::vector<CurvePiece>& pieces = pieces_.pieces();
    const std::size_t count = std::min(pieces.size(), max_pieces);
    std::vector<CurvePiece> fewer;
    for (std::size_t i = 0; i < count; ++i) {
        fewer.push_back(pieces[i * pieces.size() / count]);
        for (std::size_t j = i * pieces.size() / count + 1; j < (i + 1) * pieces.size() / count; ++j) {
            fewer.back() = joined(fewer.back(), pieces[j]);
        }
    }
    return fewer;
}

void Curve::thin(std::size_t max_pieces) {
    const std::vector<CurvePiece> fewer = thinned(max_pieces);
    pieces_ = {};
    for (const CurvePiece& piece : fewer) { pieces_.add(piece); }
}

PlotSeries Curve::series(std::size_t max_pieces) const {
    PlotSeries series;
    const auto add_point = [&](const glm::dvec2& point) {
        series.x.push_back(point.x);
        series.y.push_back(point.y);
    };
    for (const CurvePiece& piece : thinned(max_pieces)) {
        const bool rises = piece.lowest.x <= piece.highest.x;
        add_point(rises ? piece.lowest : piece.highest);
        if (piece.lowest.x != piece.highest.x) { add_point(rises ? piece.highest : piece.lowest); }
    }
    return series;
}

void DeadlineStatistics::add(const FrameRecord& record) {
    if (record.is_counted() && std::isfinite(record.latency_ms)) {
        latency_.add(record.latency_ms);
        missed_ += record.missed;
    }
}

NamedValues DeadlineStatistics::rows() const {
    const Statistics latency = latency_.statistics();
    if (latency.frames == 0) { return {}; }
    return {
        {"latency, median and 99th percentile", fmt::format("{:.2f} ms, {:.2f} ms", latency.p50_ms, latency.p99_ms)},
        {"deadlines missed", fmt::format("{} of {}", missed_, latency.frames)}};
}

void LinkStatistics::add(const FrameRecord& record) {
    ++frames_;
    packets_ += record.packets;
    if (std::isfinite(record.packets_lost)) { lost_ = lost_.value_or(0) + std::lround(record.packets_lost); }
    late_ += record.packets_late;
    wrong_ += record.packets_wrong;
    stale_ += record.stale;
    jitter_ms_ += record.jitter_ms;
    if (record.host_frame >= 0) {
        first_host_frame_ = hosted_ == 0 ? record.host_frame : first_host_frame_;
        last_host_frame_ = record.host_frame;
        ++hosted_;
    }
    if (record.skew_frames >= 0) {
        ++sent_;
        max_skew_ = std::max(max_skew_, record.skew_frames);
        skewed_ += record.skew_frames > 0 ? 1 : 0;
    }
}

NamedValues LinkStatistics::rows() const {
    NamedValues rows;
    if (sent_ > 0) {
        rows.emplace_back(
            "channels: skew at most, frames with any", fmt::format("{} frames, {} of {}", max_skew_, skewed_, sent_));
    }
    if (hosted_ > 0) {
        rows.emplace_back("frames of the CIGI host",
            fmt::format("{} pictures of frames {} to {}", hosted_, first_host_frame_, last_host_frame_));
    }
    if (packets_ + wrong_ == 0) { return rows; }
    const NamedValues of_packets{
        {"packets taken, lost, late, wrong",
            fmt::format("{}, {}, {}, {}", packets_, lost_ ? fmt::format("{}", *lost_) : "unknown", late_, wrong_)},
        {"frames with an aircraft that stood for want of packets", fmt::format("{} of {}", stale_, frames_)},
        {"jitter of packets, mean", fmt::format("{:.1f} ms", jitter_ms_ / static_cast<double>(frames_))}};
    rows.insert(rows.end(), of_packets.begin(), of_packets.end());
    return rows;
}

void FlightAccumulator::add(const FrameRecord& record) {
    const double at_s = record.sim_time_s;
    begin_s_ = frames_ == 0 ? at_s : begin_s_;
    end_s_ = at_s;
    ++frames_;
    has_stages_ = has_stages_ || record.sim_ms + record.plan_ms + record.draw_ms + record.read_ms > 0.0 ||
                  record.terrain_triangles > 0;
    times_.add(record);
    link.add(record);
    if (record.warm_up) {
        warm_up_ms.add(at_s, record.frame_ms);
        return;
    }
    if (record.paused) {
        ++paused_frames_;
        return;
    }
    frame_ms.add(at_s, record.frame_ms);
    triangles.add(at_s, record.terrain_triangles);
    triangle_change.add(at_s, record.triangle_change);
    triangle_target.add(at_s, record.triangle_target);
    stress.add(at_s, record.stress);
    stages.add({at_s, record.frame_ms, record.sim_ms, record.plan_ms, record.draw_ms, record.read_ms});
    slow.add(record);
    clock.add(record);
    const int target = record.triangle_target;
    targets_.min_triangles = reported_counts_ == 0 ? target : std::min(targets_.min_triangles, target);
    targets_.max_triangles = std::max(targets_.max_triangles, target);
    targets_.mean += target;
    ++reported_counts_;
}

void FlightAccumulator::keep_frame_times(std::size_t max_pieces) {
    FlightAccumulator fewer;
    fewer.frames_ = frames_;
    fewer.paused_frames_ = paused_frames_;
    fewer.begin_s_ = begin_s_;
    fewer.end_s_ = end_s_;
    fewer.has_stages_ = has_stages_;
    fewer.reported_counts_ = reported_counts_;
    fewer.targets_ = targets_;
    fewer.frame_ms = std::move(frame_ms);
    fewer.frame_ms.thin(max_pieces);
    *this = std::move(fewer);
}

TargetRange FlightAccumulator::triangle_targets() const {
    TargetRange range = targets_;
    range.mean = reported_counts_ > 0 ? targets_.mean / static_cast<double>(reported_counts_) : 0.0;
    return range;
}

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

/// A plot of one curve over simulated time.
Plot curve_plot(
    const char* title, const char* y_label, const Curve& curve, const char* colour, std::optional<double> y_min = 0.0) {
    Plot plot{title, time_label, y_label, {}, {}, y_min, {}};
    plot.series = {named(curve.series(), "", colour)};
    return plot;
}

} // namespace

std::size_t max_curve_pieces(std::size_t flights) {
    return std::clamp<std::size_t>(80'000 / flights, 20, 400); // of two points of some 11 bytes
}

double plot_ceiling_ms(const Statistics& statistics) {
    constexpr double room_for_level_ms = 18.0; // for the line of 16.67 ms
    const double needed_ms = std::min(statistics.max_ms, 2.5 * statistics.p99_ms);
    const bool is_far_below = needed_ms > 0.0 && needed_ms < room_for_level_ms / 4.0;
    return 1.05 * (is_far_below ? needed_ms : std::max(room_for_level_ms, needed_ms));
}

std::vector<Plot> flight_plots(const FlightAccumulator& flight, double ceiling_ms) {
    std::vector<Plot> plots = {frame_time_plot(flight, ceiling_ms), histogram_plot(flight.times())};
    if (!flight.has_stages()) {
        plots.front().x_label = "time, s";
        return plots;
    }
    plots.push_back(stage_plot(flight, ceiling_ms));
    plots.push_back(curve_plot("Terrain triangles", "triangles", flight.triangles, green));
    plots.push_back(curve_plot(
        "Change of terrain triangles from frame to frame", "triangles", flight.triangle_change, violet, std::nullopt));
    if (flight.triangle_targets().varies()) {
        plots.push_back(curve_plot("Triangle target", "triangles", flight.triangle_target, amber));
        plots.push_back(curve_plot("Stress", "share of the frame", flight.stress, blue));
        plots.back().levels = {{"whole frame", 1.0}};
    }
    return plots;
}

} // namespace octant::ui::report
