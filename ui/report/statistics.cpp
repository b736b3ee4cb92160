#include "ui/report/statistics.h"

#include "sim/base/nearest_rank.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace octant::ui::report {

namespace {

using S = Statistics;
constexpr std::array statistic_table{
    Statistic{column<&S::frames>("frames", "Frames", 0,
                  "Frames counted: all but those of the warm-up and those in which the program was stopped."),
        false},
    Statistic{column<&S::mean_ms>("mean_ms", "Mean, ms", 3, "Arithmetic mean of the frame times.")},
    Statistic{column<&S::sd_ms>("sd_ms", "Standard deviation, ms", 3, "Sample standard deviation (divisor n - 1).")},
    Statistic{column<&S::p50_ms>("p50_ms", "P50, ms", 3,
        "Median by nearest rank: the frame time of rank ceil(0.50 n) of the n sorted upwards.")},
    Statistic{column<&S::p90_ms>("p90_ms", "P90, ms", 3, "Nearest rank: rank ceil(0.90 n).")},
    Statistic{column<&S::p95_ms>("p95_ms", "P95, ms", 3, "Nearest rank: rank ceil(0.95 n).")},
    Statistic{column<&S::p99_ms>("p99_ms", "P99, ms", 3, "Nearest rank: rank ceil(0.99 n).")},
    Statistic{column<&S::p999_ms>("p999_ms", "P99.9, ms", 3, "Nearest rank: rank ceil(0.999 n).")},
    Statistic{column<&S::max_ms>("max_ms", "Longest, ms", 3, "The longest frame time.")},
    Statistic{column<&S::low_1pct_fps>(
                  "low_1pct_fps", "1 % low, frames/s", 2, "1000 / mean of the ceil(0.01 n) longest frame times."),
        false},
    Statistic{column<&S::low_01pct_fps>(
                  "low_01pct_fps", "0.1 % low, frames/s", 2, "1000 / mean of the ceil(0.001 n) longest frame times."),
        false},
    Statistic{column<&S::overruns_16ms>(
        "overruns_16ms", "Overruns of 16.67 ms", 0, "Frames longer than 16.67 ms (60 pictures a second).")},
    Statistic{column<&S::overruns_33ms>(
        "overruns_33ms", "Overruns of 33.3 ms", 0, "Frames longer than 33.3 ms (30 pictures a second).")},
    Statistic{column<&S::overruns_41ms>(
        "overruns_41ms", "Overruns of 41.7 ms", 0, "Frames longer than 41.7 ms (24 pictures a second).")},
    Statistic{column<&S::jitter_ms>(
        "jitter_ms", "Jitter, ms", 3, "Mean of |change of frame time| from one frame to the next.")},
};

} // namespace

std::span<const Statistic> all_statistics() { return statistic_table; }

std::string statistic_text(const Statistic& statistic, const Statistics& statistics) {
    if (statistics.frames == 0 && statistic.decimals > 0) { return "-"; }
    return text_of(statistic, statistics);
}

void FrameTimeHistogram::add(double frame_ms) {
    ++counts_[frame_ms];
    if (frames_++ > 0) { change_ms_ += std::abs(frame_ms - last_ms_); }
    last_ms_ = frame_ms;
}

void FrameTimeHistogram::add(const FrameRecord& record) {
    if (record.is_counted()) { add(record.frame_ms); }
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

std::array<double, 5> stages_of(const FrameRecord& record) {
    constexpr double decimals = 1e4;
    const double timed_ms = record.sim_ms + record.plan_ms + record.draw_ms + record.read_ms;
    return {record.sim_ms, record.plan_ms, record.draw_ms, record.read_ms,
        std::round(std::max(0.0, record.frame_ms - timed_ms) * decimals) / decimals};
}

namespace {

std::size_t index_of_greatest(const std::array<double, 5>& values) {
    return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

} // namespace

void SlowFrameList::add(const FrameRecord& record) {
    if (!record.is_counted()) { return; }
    const std::array<double, 5> stage_ms = stages_of(record);
    for (std::size_t i = 0; i < stages_.size(); ++i) { stages_[i].add(stage_ms[i]); }
    if (record.frame_ms > overrun_16_ms) { ++above_16_ms_[index_of_greatest(stage_ms)]; }
    const auto place =
        std::ranges::find_if(slowest_, [&](const FrameRecord& kept) { return kept.frame_ms < record.frame_ms; });
    if (place == slowest_.end() && slowest_.size() == max_kept) { return; }
    slowest_.insert(place, record);
    slowest_.resize(std::min(slowest_.size(), max_kept));
}

std::vector<SlowFrame> SlowFrameList::slowest() const {
    std::array<double, 5> medians_ms{};
    std::ranges::transform(
        stages_, medians_ms.begin(), [](const FrameTimeHistogram& stage) { return stage.statistics().p50_ms; });
    std::vector<SlowFrame> overruns;
    for (const FrameRecord& record : slowest_) {
        SlowFrame overrun;
        overrun.record = record;
        overrun.stage_ms = stages_of(record);
        overrun.longest_stage = index_of_greatest(overrun.stage_ms);
        std::array<double, 5> growth = overrun.stage_ms;
        for (std::size_t i = 0; i < growth.size(); ++i) { growth[i] -= medians_ms[i]; }
        overrun.slowed_stage = index_of_greatest(growth);
        overrun.slowdown_ms = growth[overrun.slowed_stage];
        overruns.push_back(overrun);
    }
    return overruns;
}

} // namespace octant::ui::report
