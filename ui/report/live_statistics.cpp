#include "ui/report/live_statistics.h"

#include "ui/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::ui::report {

void DeadlineStatistics::add(const FrameRecord& record) {
    if (!record.warm_up && std::isfinite(record.latency_ms)) {
        latency_.add(record.latency_ms);
        missed_ += record.missed;
    }
}

NamedValues DeadlineStatistics::rows() const {
    const Statistics latency = latency_.statistics();
    if (latency.frames == 0) {
        return {};
    }
    return {
        {"latency, median and 99th percentile",
         fmt::format("{:.2f} ms, {:.2f} ms", latency.p50_ms, latency.p99_ms)},
        {"deadlines missed", fmt::format("{} of {}", missed_, latency.frames)}};
}

void LinkStatistics::add(const FrameRecord& record) {
    ++frames_;
    packets_ += record.packets;
    if (std::isfinite(record.packets_lost)) {
        lost_ = lost_.value_or(0) + std::lround(record.packets_lost);
    }
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
            "channels: skew at most, frames with any",
            fmt::format("{} frames, {} of {}", max_skew_, skewed_, sent_));
    }
    if (hosted_ > 0) {
        rows.emplace_back(
            "frames of the CIGI host",
            fmt::format(
                "{} pictures of frames {} to {}", hosted_, first_host_frame_, last_host_frame_));
    }
    if (packets_ + wrong_ == 0) {
        return rows;
    }
    const NamedValues of_packets{
        {"packets taken, lost, late, wrong",
         fmt::format(
             "{}, {}, {}, {}",
             packets_,
             lost_ ? fmt::format("{}", *lost_) : "unknown",
             late_,
             wrong_)},
        {"frames with an aircraft that stood for want of packets",
         fmt::format("{} of {}", stale_, frames_)},
        {"jitter of packets, mean",
         fmt::format("{:.1f} ms", jitter_ms_ / static_cast<double>(frames_))}};
    rows.insert(rows.end(), of_packets.begin(), of_packets.end());
    return rows;
}

} // namespace octant::ui::report
