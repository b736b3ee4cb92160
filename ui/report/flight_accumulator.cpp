#include "ui/report/flight_accumulator.h"

#include "ui/report/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

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

PlotSeries Curve::series(std::size_t max_pieces) const {
    assert(max_pieces >= 1);
    PlotSeries series;
    const auto add_point = [&](const glm::dvec2& point) {
        series.x.push_back(point.x);
        series.y.push_back(point.y);
    };
    const std::vector<CurvePiece>& pieces = pieces_.pieces();
    const std::size_t count = std::min(pieces.size(), max_pieces);
    for (std::size_t i = 0; i < count; ++i) {
        CurvePiece piece = pieces[i * pieces.size() / count];
        for (std::size_t j = i * pieces.size() / count + 1; j < (i + 1) * pieces.size() / count; ++j) {
            piece = joined(piece, pieces[j]);
        }
        const bool rises = piece.lowest.x <= piece.highest.x;
        add_point(rises ? piece.lowest : piece.highest);
        if (piece.lowest.x != piece.highest.x) { add_point(rises ? piece.highest : piece.lowest); }
    }
    return series;
}

void DeadlineStatistics::add(const FrameRecord& record) {
    if (!record.warm_up && std::isfinite(record.latency_ms)) {
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
    times_.add(record);
    link.add(record);
    if (record.warm_up) {
        warm_up_ms.add(at_s, record.frame_ms);
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

TargetRange FlightAccumulator::triangle_targets() const {
    TargetRange range = targets_;
    range.mean = reported_counts_ > 0 ? targets_.mean / static_cast<double>(reported_counts_) : 0.0;
    return range;
}

} // namespace octant::ui::report
