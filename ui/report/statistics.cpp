#include "ui/report/statistics.h"

#include "sim/base/nearest_rank.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace octant::ui::report {

namespace {

template <auto Member>
constexpr double value_of(const Statistics& statistics) {
    return static_cast<double>(statistics.*Member);
}

using S = Statistics;
constexpr std::array all_figures{
    Figure{
        "frames",
        "Frames",
        "Frames counted: all but the warm-up frames.",
        0,
        false,
        value_of<&S::frames>},
    Figure{
        "mean_ms",
        "Mean, ms",
        "Arithmetic mean of the frame times.",
        3,
        true,
        value_of<&S::mean_ms>},
    Figure{
        "sd_ms",
        "Standard deviation, ms",
        "Sample standard deviation (divisor n - 1).",
        3,
        true,
        value_of<&S::sd_ms>},
    Figure{
        "p50_ms",
        "P50, ms",
        "Median by nearest rank: the frame time of rank ceil(0.50 n) of the n sorted upwards.",
        3,
        true,
        value_of<&S::p50_ms>},
    Figure{"p90_ms", "P90, ms", "Nearest rank: rank ceil(0.90 n).", 3, true, value_of<&S::p90_ms>},
    Figure{"p95_ms", "P95, ms", "Nearest rank: rank ceil(0.95 n).", 3, true, value_of<&S::p95_ms>},
    Figure{"p99_ms", "P99, ms", "Nearest rank: rank ceil(0.99 n).", 3, true, value_of<&S::p99_ms>},
    Figure{
        "p999_ms",
        "P99.9, ms",
        "Nearest rank: rank ceil(0.999 n).",
        3,
        true,
        value_of<&S::p999_ms>},
    Figure{"max_ms", "Longest, ms", "The longest frame time.", 3, true, value_of<&S::max_ms>},
    Figure{
        "low_1pct_fps",
        "1 % low, frames/s",
        "1000 / mean of the ceil(0.01 n) longest frame times.",
        2,
        false,
        value_of<&S::low_1pct_fps>},
    Figure{
        "low_01pct_fps",
        "0.1 % low, frames/s",
        "1000 / mean of the ceil(0.001 n) longest frame times.",
        2,
        false,
        value_of<&S::low_01pct_fps>},
    Figure{
        "overruns_16ms",
        "Overruns of 16.67 ms",
        "Frames longer than 16.67 ms (60 pictures a second).",
        0,
        true,
        value_of<&S::overruns_16ms>},
    Figure{
        "overruns_33ms",
        "Overruns of 33.3 ms",
        "Frames longer than 33.3 ms (30 pictures a second).",
        0,
        true,
        value_of<&S::overruns_33ms>},
    Figure{
        "overruns_41ms",
        "Overruns of 41.7 ms",
        "Frames longer than 41.7 ms (24 pictures a second).",
        0,
        true,
        value_of<&S::overruns_41ms>},
    Figure{
        "jitter_ms",
        "Jitter, ms",
        "Mean of |change of frame time| from one frame to the next.",
        3,
        true,
        value_of<&S::jitter_ms>},
};

double mean_of(std::span<const double> values) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return sum / static_cast<double>(values.size());
}

double sample_deviation(std::span<const double> values, double mean) {
    if (values.size() < 2) {
        return 0.0;
    }
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - mean) * (value - mean);
    }
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double mean_change(std::span<const double> values) {
    if (values.size() < 2) {
        return 0.0;
    }
    double sum = 0.0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        sum += std::abs(values[i] - values[i - 1]);
    }
    return sum / static_cast<double>(values.size() - 1);
}

double low_fps(std::span<const double> sorted, int permille) {
    const double slowest_ms = mean_of(sorted.last(rank_of(sorted.size(), permille)));
    return slowest_ms > 0.0 ? 1000.0 / slowest_ms : 0.0;
}

int count_above(std::span<const double> sorted, double limit_ms) {
    return static_cast<int>(
        sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), limit_ms));
}

} // namespace

std::span<const Figure> figures() {
    return all_figures;
}

double nearest_rank(std::span<const double> sorted, int permille) {
    assert(permille >= 1 && permille <= 1000);
    return sorted.empty() ? 0.0 : sorted[rank_of(sorted.size(), permille) - 1];
}

Statistics statistics_of_times(std::span<const double> frame_ms) {
    Statistics result;
    if (frame_ms.empty()) {
        return result;
    }
    std::vector<double> sorted(frame_ms.begin(), frame_ms.end());
    std::sort(sorted.begin(), sorted.end());
    result.frames = static_cast<int>(frame_ms.size());
    result.mean_ms = mean_of(frame_ms);
    result.sd_ms = sample_deviation(frame_ms, result.mean_ms);
    result.p50_ms = nearest_rank(sorted, 500);
    result.p90_ms = nearest_rank(sorted, 900);
    result.p95_ms = nearest_rank(sorted, 950);
    result.p99_ms = nearest_rank(sorted, 990);
    result.p999_ms = nearest_rank(sorted, 999);
    result.max_ms = sorted.back();
    result.low_1pct_fps = low_fps(sorted, 10);
    result.low_01pct_fps = low_fps(sorted, 1);
    result.overruns_16ms = count_above(sorted, overrun_16_ms);
    result.overruns_33ms = count_above(sorted, overrun_33_ms);
    result.overruns_41ms = count_above(sorted, overrun_41_ms);
    result.jitter_ms = mean_change(frame_ms);
    return result;
}

Statistics statistics_of(std::span<const FrameRecord> records) {
    std::vector<double> frame_ms;
    for (const FrameRecord& record : records) {
        if (!record.warm_up) {
            frame_ms.push_back(record.frame_ms);
        }
    }
    return statistics_of_times(frame_ms);
}

} // namespace octant::ui::report
