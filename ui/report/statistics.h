#pragma once

#include <span>
#include <string>
#include <string_view>

namespace octant::ui::report {

/// Frame-time figures of a flight, without its warm-up frames. Each is defined in words by all_statistics(). No frames:
/// all zero (statistic_text() tells). One frame: sd and jitter are zero.
struct Statistics {
    int frames = 0;
    double mean_ms = 0.0;
    double sd_ms = 0.0;
    double p50_ms = 0.0;
    double p90_ms = 0.0;
    double p95_ms = 0.0;
    double p99_ms = 0.0;
    double p999_ms = 0.0;
    double max_ms = 0.0;
    double low_1pct_fps = 0.0;
    double low_01pct_fps = 0.0;
    int overruns_16ms = 0;
    int overruns_33ms = 0;
    int overruns_41ms = 0;
    double jitter_ms = 0.0;

    bool operator==(const Statistics&) const = default;
};

/// Frame times above these are overruns: 60, 30 and 24 pictures a second.
inline constexpr double overrun_16_ms = 16.67;
inline constexpr double overrun_33_ms = 33.3;
inline constexpr double overrun_41_ms = 41.7;

/// One figure of Statistics for files and tables.
struct Statistic {
    std::string_view key;  ///< in run.json under "summary"
    std::string_view name; ///< for people, with its unit
    std::string_view definition;
    int decimals; ///< 0 for counts
    bool less_is_better;
    double (*value)(const Statistics&);
};

/// All figures in the order of run.json.
std::span<const Statistic> all_statistics();

/// A figure as people read it, with its decimals; "-" for a time or rate of no frames.
std::string statistic_text(const Statistic& statistic, const Statistics& statistics);

/// The value of rank ceil(n * permille / 1000), counted from 1, of values sorted upwards. `permille` in [1, 1000]; 0
/// when there are no values.
double nearest_rank(std::span<const double> sorted, int permille);

} // namespace octant::ui::report
