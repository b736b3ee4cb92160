#pragma once

#include "ui/report/html_text.h"
#include "ui/settings/settings.h"

namespace octant::ui::studies::flicker {

/// How shimmer is measured.
struct ShimmerOptions {
    settings::RunSettings settings =
        settings::measurement_settings(); ///< terrain, size, triangles, error_px, rate, frames, ...
    int every = 60;                  ///< a pair of consecutive frames in so many
    int jobs = 1;                    ///< paths at once
    bool quiet = false;
};

/// A row a path and one for all: mean change of reprojected pixels for one and four samples a
/// pixel, geomorphs off and on. Draws. Throws Error.
report::HtmlTable shimmer_table(const ShimmerOptions& options);

} // namespace octant::ui::studies::flicker
