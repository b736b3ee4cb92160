#pragma once

#include "ui/report/curve.h"
#include "ui/report/frame_record.h"
#include "ui/report/frame_times.h"
#include "ui/report/run_file.h"
#include "ui/report/slow_frames.h"
#include "ui/report/stage_columns.h"

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

/// Triangles of ground that a flight's frames aimed at.
struct TargetRange {
    int min_triangles = 0;
    int max_triangles = 0;
    double mean = 0.0;

    /// True when the target was not the same throughout.
    bool varies() const { return min_triangles < max_triangles; }
};

/// What a report shows of a flight's frames. They are added one by one in flight order and not kept, so that a flight
/// of a million takes no more memory than one of ten thousand.
class FlightAccumulator {
public:
    void add(const FrameRecord& record);

    /// All of them, with the warm-up.
    int frames() const { return frames_; }

    /// Simulated times of the first and the last one.
    double begin_s() const { return begin_s_; }

    double end_s() const { return end_s_; }

    /// Of the frames without the warm-up, as all that follows.
    const FrameTimeHistogram& times() const { return times_; }

    TargetRange triangle_targets() const;

    Curve warm_up_ms; ///< frame times of the warm-up; all curves are over simulated time
    Curve frame_ms;
    Curve triangles;
    Curve triangle_change;
    Curve triangle_target;
    Curve stress;
    StageColumns stages;
    SlowFrameList slow;
    DeadlineStatistics clock;
    LinkStatistics link; ///< with the warm-up

private:
    int frames_ = 0;
    double begin_s_ = 0.0;
    double end_s_ = 0.0;
    FrameTimeHistogram times_;
    long reported_counts_ = 0;
    TargetRange targets_; ///< mean is the sum
};

} // namespace octant::ui::report
