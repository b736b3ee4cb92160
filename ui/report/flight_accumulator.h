#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/plots.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace octant::ui::report {

/// The stages of a flight's frames in the memory of a plot: where there are more frames than columns, neighbours share
/// one, which shows the longest of them.
class StageColumns {
public:
    static constexpr std::size_t max_columns = 400; ///< each wide enough to be seen

    struct Column {
        double x_s = 0.0; ///< simulated time of its first frame
        double frame_ms = 0.0;
        double sim_ms = 0.0;
        double plan_ms = 0.0;
        double draw_ms = 0.0;
        double read_ms = 0.0;
    };

    void add(const FrameRecord& record);

    const std::vector<Column>& columns() const { return columns_; }

    /// Simulated time of the last frame.
    double end_s() const { return end_s_; }

    bool is_thinned() const { return frames_per_column_ > 1; }

private:
    std::vector<Column> columns_;
    std::size_t frames_per_column_ = 1;
    std::size_t in_last_bucket_ = 0;
    double end_s_ = 0.0;
};

/// A curve over a flight in the memory of a plot: where there are more points than it keeps pieces, neighbours share
/// one, which keeps its least and its greatest value.
class Curve {
public:
    /// More pieces than a page's plot has pixels.
    static constexpr std::size_t max_pieces = 900;

    /// `x` not below that of the last point. A value that is not finite is a gap.
    void add(double x, double y);

    /// Its points in order, two a piece at the most, in at most so many pieces (>= 1).
    PlotSeries series(std::size_t buckets = max_pieces) const;

private:
    struct Point {
        double x = 0.0;
        double y = 0.0;
    };

    struct Bucket {
        Point lowest;
        Point highest;
    };

    static Bucket joined(const Bucket& a, const Bucket& b);

    std::vector<Bucket> buckets_;
    std::size_t points_per_bucket_ = 1;
    std::size_t in_last_bucket_ = 0;
};

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
