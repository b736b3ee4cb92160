#include "ui/report/frame_times.h"

#include "sim/base/nearest_rank.h"

#include <algorithm>
#include <cmath>

namespace octant::ui::report {

void FrameTimeHistogram::add(double frame_ms) {
    ++counts_[frame_ms];
    if (frames_++ > 0) { change_ms_ += std::abs(frame_ms - last_ms_); }
    last_ms_ = frame_ms;
}

void FrameTimeHistogram::add(const FrameRecord& record) {
    if (!record.warm_up) { add(record.frame_ms); }
}

/// The time of that rank, counted from 1 upwards.
double FrameTimeHistogram::at_rank(std::uint64_t rank) const {
    std::uint64_t passed = 0;
    for (const auto& [frame_ms, count] : counts_) {
        passed += count;
        if (passed >= rank) { return frame_ms; }
    }
    return 0.0;
}

double FrameTimeHistogram::low_fps(int permille) const {
    const std::uint64_t slowest = rank_of(frames_, permille);
    std::uint64_t left = slowest;
    double sum_ms = 0.0;
    for (auto at = counts_.rbegin(); at != counts_.rend() && left > 0; ++at) {
        const std::uint64_t taken = std::min(at->second, left);
        sum_ms += static_cast<double>(taken) * at->first;
        left -= taken;
    }
    const double mean_ms = sum_ms / static_cast<double>(slowest);
    return mean_ms > 0.0 ? 1000.0 / mean_ms : 0.0;
}

int FrameTimeHistogram::count_above(double limit_ms) const {
    std::uint64_t count = 0;
    for (auto at = counts_.upper_bound(limit_ms); at != counts_.end(); ++at) { count += at->second; }
    return static_cast<int>(count);
}

Statistics FrameTimeHistogram::statistics() const {
    Statistics result;
    if (frames_ == 0) { return result; }
    const auto n = static_cast<double>(frames_);
    double sum_ms = 0.0;
    for (const auto& [frame_ms, count] : counts_) { sum_ms += static_cast<double>(count) * frame_ms; }
    result.frames = static_cast<int>(frames_);
    result.mean_ms = sum_ms / n;
    double squares = 0.0;
    for (const auto& [frame_ms, count] : counts_) {
        const double off_ms = frame_ms - result.mean_ms;
        squares += static_cast<double>(count) * off_ms * off_ms;
    }
    if (frames_ > 1) {
        result.sd_ms = std::sqrt(squares / (n - 1.0));
        result.jitter_ms = change_ms_ / (n - 1.0);
    }
    result.p50_ms = at_rank(rank_of(frames_, 500));
    result.p90_ms = at_rank(rank_of(frames_, 900));
    result.p95_ms = at_rank(rank_of(frames_, 950));
    result.p99_ms = at_rank(rank_of(frames_, 990));
    result.p999_ms = at_rank(rank_of(frames_, 999));
    result.max_ms = counts_.rbegin()->first;
    result.low_1pct_fps = low_fps(10);
    result.low_01pct_fps = low_fps(1);
    result.overruns_16ms = count_above(overrun_16_ms);
    result.overruns_33ms = count_above(overrun_33_ms);
    result.overruns_41ms = count_above(overrun_41_ms);
    return result;
}

Statistics statistics_of_times(std::span<const double> frame_ms) {
    FrameTimeHistogram times;
    for (const double each_ms : frame_ms) { times.add(each_ms); }
    return times.statistics();
}

Statistics statistics_of(std::span<const FrameRecord> records) {
    FrameTimeHistogram times;
    for (const FrameRecord& record : records) { times.add(record); }
    return times.statistics();
}

} // namespace octant::ui::report
