#pragma once

#include "ui/base/study_output.h"
#include "ui/settings/settings.h"

namespace octant::ui::studies::flicker {

struct PoppingStudyOptions : base::StudyOutput {
    settings::RunSettings settings =
        settings::measurement_settings(); ///< terrain, size, triangles, error_px, rate, frames, ...
    bool shimmer = false;
    int every = 60; ///< shimmer: a pair of frames in so many
    int jobs = 1;   ///< flights at once
};

/// Along the four paths of the F-15, frame by frame: the largest jump of a vertex by change of
/// level of detail, pixels, for the mid-point mesh with an exact budget and for the mesh by
/// screen-space error without and with geomorphs; with near detail also for that with the detail
/// that is drawn near the eye. With `shimmer` also how much the ground's pixels change between
/// consecutive frames once the motion is taken out, for one and four samples a pixel, geomorphs off
/// and on. Prints the tables and writes them to `out` as CSV and together as Markdown. Throws
/// Error.
void study_popping(const PoppingStudyOptions& options);

} // namespace octant::ui::studies::flicker
