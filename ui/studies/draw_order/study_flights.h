#pragma once

#include "ui/base/study_output.h"
#include "ui/settings/settings.h"

namespace octant::ui::studies::draw_order {

struct FlightStudyOptions : base::StudyOutput {
    settings::RunSettings settings = settings::measurement_settings(); ///< size, samples and context are taken from it
    int jobs = 1; ///< flights at once; above 1 their times depend on each other
};

/// Repeats tables 5 and 6 of the 1989 paper: aircraft alone (100 frames of an orbit), and the four paths over the
/// 60-polygon background with one frame per path sample, for octant order, depth buffer and back-face removal by OpenGL
/// and for all methods of the raster renderer. The methods draw each frame in turn, so that load from other programs
/// affects all of them. Prints the tables next to the paper's values and writes them to `out` as CSV, Markdown and
/// plot, with the recordings of the octant flights and a report. Throws Error.
void study_flights(const FlightStudyOptions& options);

} // namespace octant::ui::studies::draw_order
