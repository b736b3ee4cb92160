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

/// How near the pictures of both renderers, with 1, 4 and 16 samples a pixel, come to 8 x 8 samples, over frames spread
/// along the paths of six scenes: peak signal to noise, largest error, and how many pixels change falsely when the
/// picture moves by half a pixel. Prints the tables and writes them to `out` as CSV and Markdown, with the last picture
/// of each scene in every way, and how one of its tiles is painted, as PNG. The same options give the same bytes.
/// Throws Error.
void study_pictures(const PictureStudyOptions& options);

} // namespace octant::ui::studies::draw_order
