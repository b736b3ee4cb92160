#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/plots.h"

#include <cstddef>
#include <span>
#include <vector>

namespace octant::ui::report {

/// The triangle targets of a flight's counted frames; all zero without any.
struct TargetRange {
    int least = 0;
    int greatest = 0;
    double mean = 0.0;

    bool moved() const { return greatest > least; }
};

TargetRange triangle_targets_of(std::span<const FrameRecord> records);

/// Top of a flight's frame-time plots: above 16.67 ms and above its longest counted frame, but no
/// more than 2.5 times P99, so that one stray frame does not flatten the rest (its curve leaves the
/// plot). Plots of several flights take the greatest, so that they compare by eye.
double plot_ceiling_ms(std::span<const FrameRecord> records);

/// The frame times of a flight's counted frames over simulated time, with every peak, thinned to
/// the least and the greatest of each of `pieces`.
PlotSeries frame_time_curve(std::span<const FrameRecord> records, std::size_t pieces);

/// The plots of a flight: frame time (warm-up apart), histogram, stages, terrain triangles, their
/// change; where the triangle target moved also that target and the stress. A long flight is
/// thinned to some thousand points: curves keep every peak, the stages are those of the longest
/// frame of some in a row.
std::vector<Plot> flight_plots(std::span<const FrameRecord> records, double ceiling_ms);

} // namespace octant::ui::report
