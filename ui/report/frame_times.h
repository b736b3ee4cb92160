#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/statistics.h"

#include <cstdint>
#include <map>
#include <span>

namespace octant::ui::report {

/// Frame times counted one by one, so that a flight's figures are known without its rows. Takes memory for each
/// different time, not for each frame: times rounded as frames.csv has them are hardly more than ten thousand for a
/// second of range.
class FrameTimeHistogram {
public:
    /// In flight order, in milliseconds.
    void add(double frame_ms);

    /// The same, unless it is one of the warm-up.
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

} // namespace octant::ui::report
