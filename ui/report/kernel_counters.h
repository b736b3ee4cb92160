#pragma once

#include "sim/base/column_reader.h"
#include "sim/base/stopwatch.h"
#include "ui/report/frame_record.h"
#include "ui/report/statistics.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace octant::ui::report {

/// Name of the file in a recording that has what the kernel counted in each frame.
inline constexpr const char* counters_name = "counters.csv";

/// Reads what the kernel counts of this program, and what hosts take from the machine. The latter at most once in a
/// tick of the kernel's clock, as it changes no more often.
class KernelCounters {
public:
    KernelCounters();
    ~KernelCounters();
    KernelCounters(const KernelCounters&) = delete;
    KernelCounters& operator=(const KernelCounters&) = delete;
    KernelCounters(KernelCounters&&) = delete;
    KernelCounters& operator=(KernelCounters&&) = delete;

    /// A frame begins.
    void begin();

    /// Counts since the construction; stolen time since the last call.
    FrameCounters lap();

private:
    std::uint64_t stolen_ticks();

    int stat_ = -1; ///< /proc/stat
    Stopwatch since_stolen_;
    std::uint64_t stolen_ticks_ = 0;
    std::uint64_t reported_stolen_ticks_ = 0;
    FrameCounters reported_counts_; ///< without stolen_ms
};

/// The header line of counters.csv and a frame's line, with their line ends.
std::string counters_header();
std::string counters_line(const FrameRecord& record);

/// Reads counters.csv frame by frame.
class CounterReader {
public:
    /// A file that is not there, or none of ours, has no frames.
    explicit CounterReader(const std::filesystem::path& file);

    bool is_there() const { return table_.has_value(); }

    /// Counters of a frame later than all frames queried before; all zero if the file has none for it.
    FrameCounters of(int frame);

    /// The next frame with its counters.
    std::optional<std::pair<long, FrameCounters>> next();

private:
    std::optional<ColumnReader> table_;
};

/// Fills in the counters of these frames from a counters.csv; false where there is none or it is none of ours, as in
/// recordings of earlier programs.
bool read_counters(const std::filesystem::path& file, std::span<SlowFrame> frames);

} // namespace octant::ui::report
