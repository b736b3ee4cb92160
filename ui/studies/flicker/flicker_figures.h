#pragma once

#include "ui/studies/flicker/flicker_runs.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::studies::flicker {

inline constexpr std::array flicker_weights = {1.0, 2.0, 3.0, 5.0}; ///< c of the fixed views
inline constexpr std::array damping_frame_counts = {0, 2, 4, 6, 8};     ///< r
inline constexpr std::array flicker_gains = {0.5, 1.0, 2.0, 3.0, 4.0, 5.0};
inline constexpr std::array flicker_first = {2.0, 4.0, 8.0, 16.0, 32.0, 64.0}; ///< C_0

/// Runs of one field: by way as triangle_controls counts them; those not made are empty.
struct FieldRuns {
    std::string name;                           ///< of the field
    std::vector<std::vector<FlickerRun>> fixed; ///< by flicker_weights, by way
    std::vector<double> fixed_gains;            ///< g by flicker_weights
    std::vector<FlickerRun> path;               ///< by way, c = 5
    std::vector<double> path_gains;             ///< g here and there along the path
    /// Frames until dn = 0 for ever, c = 5: of the settling way by flicker_gains, by flicker_first.
    std::vector<std::vector<std::optional<int>>> settling_frames;
    std::optional<int> settling_frames_exact;
};

struct FlickerRuns {
    FieldRuns gentle;
    FieldRuns rugged;
    std::vector<FlickerRun> damping_lengths; ///< by damping_frame_counts: damped along the rugged path, c = 5
};

/// A figure of the paper, or one more.
struct FlickerFigure {
    std::string file;    ///< without folder
    std::string caption; ///< what it shows, what the paper's shows
    std::string png;     ///< bytes; empty when gnuplot is not installed
};

/// First change that figures of a path take in: the way in from C_0 is left out.
std::size_t first_measured(std::size_t frames);

/// Figures 3, 5, 6, 8 and 9 and the damping over r. Throws Error when gnuplot fails.
std::vector<FlickerFigure> flicker_figures(const FlickerRuns& runs);

} // namespace octant::ui::studies::flicker
