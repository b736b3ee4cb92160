#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/plots.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace octant::ui::report {

/// What a plot draws of a flight, in constant memory: where more pieces are added than `max_pieces` (even), neighbours
/// share one, which is joined(earlier, later).
template <class Piece, std::size_t max_pieces>
class ThinnedPieces {
public:
    void add(const Piece& piece) {
        if (!pieces_.empty() && in_last_ < per_piece_) {
            pieces_.back() = joined(pieces_.back(), piece);
            ++in_last_;
            return;
        }
        if (pieces_.size() == max_pieces) {
            for (std::size_t i = 0; 2 * i < max_pieces; ++i) {
                pieces_[i] = joined(pieces_[2 * i], pieces_[2 * i + 1]);
            }
            pieces_.resize(max_pieces / 2);
            per_piece_ *= 2;
        }
        pieces_.push_back(piece);
        in_last_ = 1;
    }

    const std::vector<Piece>& pieces() const { return pieces_; }

    bool is_thinned() const { return per_piece_ > 1; }

private:
    std::vector<Piece> pieces_;
    std::size_t per_piece_ = 1;
    std::size_t in_last_ = 0;
};

/// The stages of a frame, or of the longest of some frames in a row.
struct StageColumn {
    double x_s = 0.0; ///< simulated time of the first of these frames
    double frame_ms = 0.0;
    double sim_ms = 0.0;
    double plan_ms = 0.0;
    double draw_ms = 0.0;
    double read_ms = 0.0;
};

StageColumn joined(const StageColumn& earlier, const StageColumn& later);

/// As many columns as can be told apart in a plot.
using StageColumns = ThinnedPieces<StageColumn, 400>;

/// Some points of a curve in a row: the lowest and the highest of them.
struct CurvePiece {
    glm::dvec2 lowest{0.0};
    glm::dvec2 highest{0.0};
};

CurvePiece joined(const CurvePiece& earlier, const CurvePiece& later);

/// A curve over a flight. Where there are more points than pixels in a page's plot, its lowest and highest points are
/// left.
class Curve {
public:
    /// `x` not below that of the last point. A value that is not finite is a gap.
    void add(double x, double y) { pieces_.add({{x, y}, {x, y}}); }

    /// Its points in order, in at most `max_pieces` (>= 1) pieces of two points each.
    PlotSeries series(std::size_t max_pieces = 900) const;

    /// Joins pieces until there are at most `max_pieces` (>= 1).
    void thin(std::size_t max_pieces);

private:
    std::vector<CurvePiece> thinned(std::size_t max_pieces) const;

    ThinnedPieces<CurvePiece, 900> pieces_;
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

    /// Those after the warm-up in which the program was stopped. No figure and no curve has them.
    int paused_frames() const { return paused_frames_; }

    /// Simulated times of the first and the last one.
    double begin_s() const { return begin_s_; }

    double end_s() const { return end_s_; }

    /// Of the frames that count, as all that follows.
    const FrameTimeHistogram& times() const { return times_; }

    TargetRange triangle_targets() const;

    /// False where no frame has the time of a stage or ground, as in frame times that another program recorded.
    bool has_stages() const { return has_stages_; }

    /// Forgets what a page of several flights does not show: all but the counts of frames, the simulated times, and the
    /// curve of frame times in at most `max_pieces` (>= 1). Ends adding.
    void keep_frame_times(std::size_t max_pieces);

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
    int paused_frames_ = 0;
    double begin_s_ = 0.0;
    double end_s_ = 0.0;
    bool has_stages_ = false;
    FrameTimeHistogram times_;
    long reported_counts_ = 0;
    TargetRange targets_; ///< mean is the sum
};

/// Pieces of each flight's curve in a page of so many flights (>= 1): fewer where there are many, so that a page of ten
/// thousand stays below 10 MB.
std::size_t max_curve_pieces(std::size_t flights);

/// Top of a flight's frame-time plots: above its longest counted frame, but no more than 2.5 times P99, so that one
/// stray frame does not flatten the rest (its curve leaves the plot); above 16.67 ms, too, unless that is so far off
/// that the curve would lie flat on the axis. Plots of several flights take the greatest, so that they compare by eye.
double plot_ceiling_ms(const Statistics& statistics);

/// The plots of a flight: frame time (warm-up apart), histogram; where it has stages these, terrain triangles, their
/// change; where the triangle target moved also that target and the stress. A long flight is thinned to some thousand
/// points: curves keep every peak, the stages are those of the longest frame of some in a row.
std::vector<Plot> flight_plots(const FlightAccumulator& flight, double ceiling_ms);

} // namespace octant::ui::report
