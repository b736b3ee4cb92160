#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// Frame-time figures of a flight, without frames of its warm-up and those in which it was stopped. Each is defined in
/// words by all_statistics(). No frames: all zero (statistic_text() tells). One frame: sd and jitter are zero.
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

/// One figure of Statistics.
struct Statistic : Column<Statistics> {
    bool less_is_better = true;
};

/// All figures in the order of run.json.
std::span<const Statistic> all_statistics();

/// A figure as people read it, with its decimals; "-" for a time or rate of no frames.
std::string statistic_text(const Statistic& statistic, const Statistics& statistics);

/// Frame times counted one by one, so that a flight's figures are known without its rows. Takes memory for each
/// different time, not for each frame: times rounded as frames.csv has them are hardly more than ten thousand for a
/// second of range.
class FrameTimeHistogram {
public:
    /// In flight order, in milliseconds.
    void add(double frame_ms);

    /// The same, unless the frame does not count: of the warm-up, or with a pause in it.
    void add(const FrameRecord& record);

    Statistics statistics() const;

    /// How many frames took so long, by milliseconds.
    const std::map<double, std::uint64_t>& counts() const { return counts_; }

private:
    double at_rank(std::uint64_t rank) const;
    double low_fps(int permille) const;
    int count_above(double limit_ms) const;

    std::map<double, std::uint64_t> counts_;
    std::uint64_t frames_ = 0;
    double last_ms_ = 0.0;
    double change_ms_ = 0.0; ///< sum of |change| from frame to frame
};

/// The figures of rows that are all there.
Statistics statistics_of(std::span<const FrameRecord> records);

/// The same from bare frame times in milliseconds, in flight order.
Statistics statistics_of_times(std::span<const double> frame_ms);

/// The stages of a frame; `other` is the rest of frame_ms, which none of the four stages covers.
inline constexpr std::array<std::string_view, 5> stage_names{"sim", "plan", "draw", "read", "other"};

/// The times of a frame's stages with the decimals of frames.csv, so that there are not many different ones.
std::array<double, stage_names.size()> stages_of(const FrameRecord& record);

/// A slow frame and why.
struct SlowFrame {
    FrameRecord record;
    std::array<double, 5> stage_ms{}; ///< as stage_names
    std::size_t longest_stage = 0;    ///< took most of the frame
    std::size_t slowed_stage = 0;     ///< took most above its own median of the flight
    double slowdown_ms = 0.0;         ///< by that much
};

/// The slowest of a flight's frames that count, in constant memory.
class SlowFrameList {
public:
    static constexpr std::size_t max_kept = 12;

    void add(const FrameRecord& record);

    /// At most max_kept, the slowest first.
    std::vector<SlowFrame> slowest() const;

    /// Frames above overrun_16_ms by the stage that took most of each.
    const std::array<int, 5>& above_16_ms() const { return above_16_ms_; }

private:
    std::vector<FrameRecord> slowest_;
    std::array<FrameTimeHistogram, 5> stages_;
    std::array<int, 5> above_16_ms_{};
};

} // namespace octant::ui::report
