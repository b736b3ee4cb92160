#pragma once

#include "ui/base/study_output.h"

#include <filesystem>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

struct ShadingStudyOptions : base::StudyOutput {
    std::vector<std::filesystem::path> meshes; ///< files, beside the models of its own
    int size_px = 320;                         ///< of the square pictures
    bool times = true;                         ///< fly too, for frame times
    int jobs = 1; ///< models at once; flights for frame times are always one at a time
};

/// What H. Kim and H. Park's hybrid of flat and Gouraud shading (2008) shows: its operation counts,
/// and how near to all Gouraud and to shading each pixel it comes when 0 to 100 % of the polygons
/// are smooth, chosen at random, by the paper's rule and by the error in the picture; and how the
/// share follows frame times. Prints the tables and writes them to `out` as CSV and together as
/// Markdown, curves as PNG, and a strip of pictures of each model. The same options give the same
/// bytes but for frame times. Throws Error.
void study_shading(const ShadingStudyOptions& options);

} // namespace octant::ui::studies::hybrid_shading
