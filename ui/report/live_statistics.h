#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/frame_times.h"
#include "ui/report/run_file.h"

#include <optional>

namespace octant::ui::report {

/// How a flight kept up with the clock, without its warm-up frames: latency and missed deadlines.
class DeadlineStatistics {
public:
    void add(const FrameRecord& record);

    /// No rows where the flight did not follow the clock.
    NamedValues rows() const;

private:
    FrameTimeHistogram latency_;
    long missed_ = 0;
};

/// What came from outside: packets, losses, jitter, of all frames.
class LinkStatistics {
public:
    void add(const FrameRecord& record);

    /// No rows where nothing came.
    NamedValues rows() const;

private:
    long frames_ = 0;
    long packets_ = 0;
    std::optional<long> lost_; ///< nothing where no sender numbers its packets
    long late_ = 0;
    long wrong_ = 0;
    long stale_ = 0;
    double jitter_ms_ = 0.0;
    long hosted_ = 0; ///< pictures of CIGI hosts' frames
    int first_host_frame_ = -1;
    int last_host_frame_ = -1;
    long sent_ = 0; ///< frames to image generators
    int max_skew_ = 0;
    long skewed_ = 0;
};

} // namespace octant::ui::report
