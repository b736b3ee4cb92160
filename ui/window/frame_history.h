#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/statistics.h"

#include <cstddef>
#include <span>
#include <vector>

namespace octant::ui::window {

/// Holds the last frames of a window, oldest first.
class FrameHistory {
public:
    static constexpr std::size_t max_frames = 300;

    void add(const report::FrameRecord& record);

    bool empty() const { return records_.empty(); }

    const report::FrameRecord& last() const { return records_.back(); }

    std::span<const report::FrameRecord> records() const { return records_; }

    /// Returns the statistics of the frames that it holds, which are computed at every 30th frame.
    const report::Statistics& statistics() const { return statistics_; }

private:
    std::vector<report::FrameRecord> records_;
    report::Statistics statistics_;
    std::size_t added_ = 0;
};

} // namespace octant::ui::window
