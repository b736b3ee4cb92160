#pragma once

#include "ui/report/change_statistics.h"
#include "ui/report/statistics.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace octant::ui::report {

/// Frame times of one flight, without its warm-up.
struct FrameTimes {
    int first_frame = 0; ///< number of the first; the others follow without a gap
    std::vector<double> frame_ms;
    /// By stage (as stage_names), each as long as frame_ms; empty where the file knows no stages.
    std::array<std::vector<double>, stage_names.size()> stage_ms;
    std::vector<bool> paused = {}; ///< the program was stopped in the frame; as long as frame_ms, or empty: nowhere

    bool is_paused(std::size_t frame) const { return !paused.empty() && paused[frame]; }
};

/// In which way the flights of two variants are set against each other.
enum class Pairing {
    Rounds, ///< flown alternately in random order: frame k with frame k of the same round
    Frames, ///< flown in another order: frame k with frame k, and room for drift of the machine
    Figures ///< other frames: only the median frame times of the flights
};

/// Frames in a row whose time changed.
struct ChangedFrames {
    int first_frame = 0;
    int last_frame = 0;
    double change_ms = 0.0; ///< mean of these frames
    double share = 0.0;     ///< change_ms as a share of their old mean time
};

/// A stage of the frame whose time changed.
struct ChangedStage {
    std::size_t stage = 0;  ///< of stage_names
    double change_ms = 0.0; ///< mean of the changed frames, or of all
};

/// How the frame times of two sets of flights differ. Of the same frames (Rounds, Frames) all that is told can be
/// recomputed from frames.csv by these definitions. `usual` is the median of a frame's time over all flights.
/// - Frames left out: x is log(first / second time) of a round's two flights, else log(time / usual); d is the distance
///   of x from the median x of all frames of that round (flight). A round (flight) loses a frame whose d is above the
///   median of that frame's d over all rounds (flights) by more than 2.5 s; s is 1.4826 times the median distance of all
///   d from these medians, at least 0.005. Where it would lose more than half of its frames it keeps all.
/// - A flight's value is the mean of log(time / usual), weighted by usual; `change` is change_of() these values.
/// - A part of the flight: its change in milliseconds is mean_of() the rounds' differences (change_of() without rounds)
///   of the flights' mean of time - usual, in that part; of a stage the mean of the middle half of these values.
/// - `frames_changed`: the flight is cut into as many equal blocks of 4 frames or more as there are, at most 25, and
///   blocks change for sure by Holm among them. From a sure block to a sure one of the same sign, with at most one
///   other block between two, the run with the greatest sum of change in ms is taken unless it is above 70 % of the
///   flight; then, in it and a block's length beyond, the frames in a row with the greatest sum of (mean new - mean old
///   time of the frame) - half of the run's change. Nothing where they hold less than 70 % of the whole change.
/// - `stage_changed`: the greatest change among stages that change for sure, by Holm among the five.
struct FrameChange {
    Pairing pairing = Pairing::Rounds;
    std::size_t old_runs = 0;
    std::size_t new_runs = 0;
    std::size_t frames = 0; ///< of each flight
    double old_ms = 0.0;    ///< median over the flights of their mean (for Figures: median) frame times
    double new_ms = 0.0;
    /// Of the logarithm of the frame time; nothing where there are too few flights for an interval.
    std::optional<Change> change;
    double mann_whitney_p = 1.0;                 ///< of the flights' frame times
    std::optional<ChangedFrames> frames_changed; ///< where the change is not all over the flight
    std::optional<ChangedStage> stage_changed;   ///< the one that changed most, if any did for sure

    /// new / old - 1: the estimate and the ends of its interval.
    double share() const;
    double low_share() const;
    double high_share() const;
};

/// Compares the flights of two variants, in each list in the order of time. `sides`: of all flights in the order of
/// time; empty: they were flown in rounds, i-th with i-th. Each list has a flight or more, with frames. With
/// `same_frames`, frame k of all is the same frame; frames in which a program was stopped, or that something else
/// held up, are left out, by a rule that does not know the sides. Needs the memory of all frame times once more.
FrameChange frame_change(std::span<const FrameTimes> before, std::span<const FrameTimes> after,
    std::span<const Side> sides = {}, bool same_frames = true);

} // namespace octant::ui::report
