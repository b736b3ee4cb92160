#pragma once

#include "ui/base/study_output.h"

#include <string>
#include <vector>

namespace octant::ui::studies::refinement {

struct RefinementStudyOptions : base::StudyOutput {
    std::vector<std::string> meshes; ///< files; empty = made ground of 129 x 129 samples
    int base = 100;                  ///< vertices of the base meshes
    int frames = 600;                ///< of the path
};

/// What selective refinement costs beyond what was asked for: splits forced by the paper's rule and by the two earlier
/// ones, for one base vertex and for spheres; faces turned over, and splits that mend them; splits a second and bytes;
/// operations a frame along a path. Prints the tables and writes them to `out` as CSV and Markdown, and four pictures
/// of the last model. All but times are the same in every run. Throws Error.
void study_refinement(const RefinementStudyOptions& options);

} // namespace octant::ui::studies::refinement
