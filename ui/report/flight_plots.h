#pragma once

#include "ui/report/flight_accumulator.h"
#include "ui/report/plots.h"
#include "ui/report/statistics.h"

#include <vector>

namespace octant::ui::report {

/// Top of a flight's frame-time plots: above its longest counted frame, but no more than 2.5 times P99, so that one
/// stray frame does not flatten the rest (its curve leaves the plot); above 16.67 ms, too, unless that is so far off
/// that the curve would lie flat on the axis. Plots of several flights take the greatest, so that they compare by eye.
double plot_ceiling_ms(const Statistics& statistics);

/// The plots of a flight: frame time (warm-up apart), histogram, stages, terrain triangles, their change; where the
/// triangle target moved also that target and the stress. A long flight is thinned to some thousand points: curves keep
/// every peak, the stages are those of the longest frame of some in a row.
std::vector<Plot> flight_plots(const FlightAccumulator& flight, double ceiling_ms);

} // namespace octant::ui::report
