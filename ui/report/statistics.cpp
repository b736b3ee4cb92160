#include "ui/report/statistics.h"

#include "sim/base/nearest_rank.h"

#include <array>
#include <cassert>
#include <fmt/format.h>

namespace octant::ui::report {

namespace {

template <auto Member>
constexpr double value_of(const Statistics& statistics) {
    return static_cast<double>(statistics.*Member);
}

using S = Statistics;
constexpr std::array statistic_table{
    Statistic{"frames", "Frames", "Frames counted: all but the warm-up frames.", 0, false, value_of<&S::frames>},
    Statistic{"mean_ms", "Mean, ms", "Arithmetic mean of the frame times.", 3, true, value_of<&S::mean_ms>},
    Statistic{
        "sd_ms", "Standard deviation, ms", "Sample standard deviation (divisor n - 1).", 3, true, value_of<&S::sd_ms>},
    Statistic{"p50_ms", "P50, ms",
        "Median by nearest rank: the frame time of rank ceil(0.50 n) of the n sorted upwards.", 3, true,
        value_of<&S::p50_ms>},
    Statistic{"p90_ms", "P90, ms", "Nearest rank: rank ceil(0.90 n).", 3, true, value_of<&S::p90_ms>},
    Statistic{"p95_ms", "P95, ms", "Nearest rank: rank ceil(0.95 n).", 3, true, value_of<&S::p95_ms>},
    Statistic{"p99_ms", "P99, ms", "Nearest rank: rank ceil(0.99 n).", 3, true, value_of<&S::p99_ms>},
    Statistic{"p999_ms", "P99.9, ms", "Nearest rank: rank ceil(0.999 n).", 3, true, value_of<&S::p999_ms>},
    Statistic{"max_ms", "Longest, ms", "The longest frame time.", 3, true, value_of<&S::max_ms>},
    Statistic{"low_1pct_fps", "1 % low, frames/s", "1000 / mean of the ceil(0.01 n) longest frame times.", 2, false,
        value_of<&S::low_1pct_fps>},
    Statistic{"low_01pct_fps", "0.1 % low, frames/s", "1000 / mean of the ceil(0.001 n) longest frame times.", 2, false,
        value_of<&S::low_01pct_fps>},
    Statistic{"overruns_16ms", "Overruns of 16.67 ms", "Frames longer than 16.67 ms (60 pictures a second).", 0, true,
        value_of<&S::overruns_16ms>},
    Statistic{"overruns_33ms", "Overruns of 33.3 ms", "Frames longer than 33.3 ms (30 pictures a second).", 0, true,
        value_of<&S::overruns_33ms>},
    Statistic{"overruns_41ms", "Overruns of 41.7 ms", "Frames longer than 41.7 ms (24 pictures a second).", 0, true,
        value_of<&S::overruns_41ms>},
    Statistic{"jitter_ms", "Jitter, ms", "Mean of |change of frame time| from one frame to the next.", 3, true,
        value_of<&S::jitter_ms>},
};

} // namespace

std::span<const Statistic> all_statistics() { return statistic_table; }

std::string statistic_text(const Statistic& statistic, const Statistics& statistics) {
    if (statistics.frames == 0 && statistic.decimals > 0) { return "-"; }
    return fmt::format("{:.{}f}", statistic.value(statistics), statistic.decimals);
}

double nearest_rank(std::span<const double> sorted, int permille) {
    assert(permille >= 1 && permille <= 1000);
    return sorted.empty() ? 0.0 : sorted[rank_of(sorted.size(), permille) - 1];
}

} // namespace octant::ui::report
