#pragma once

#include "ui/base/study_output.h"
#include "ui/settings/settings.h"

namespace octant::ui::studies::draw_order {

struct PictureStudyOptions : base::StudyOutput {
    settings::RunSettings settings =
        settings::measurement_settings(); ///< size, triangles and context are taken from it
    int frames = 4;                       ///< of each scene
    int jobs = 1;                         ///< scenes at once
};

/// Compares the pictures of both renderers with 1, 4 and 16 samples per pixel with references of 8 x 8 samples, over
/// frames spread along the paths of six scenes: peak signal to noise ratio, largest error, and the number of pixels
/// that change wrongly when the picture moves by half a pixel. Prints the tables and writes them to `out` as CSV and
/// Markdown, with the last picture of each scene in every mode and its tile masks as PNG. The same options give the
/// same bytes. Throws Error.
void study_pictures(const PictureStudyOptions& options);

} // namespace octant::ui::studies::draw_order
