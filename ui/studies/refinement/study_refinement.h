#pragma once

#include "ui/base/output_options.h"

#include <string>
#include <vector>

namespace octant::ui::studies::refinement {

struct RefinementStudyOptions : base::StudyOutput {
    std::vector<std::string> meshes; ///< files; empty = made ground of 129 x 129 samples
    int base = 100;                  ///< vertices of the base meshes
    int frames = 600;                ///< of the path
};

/// Measures the cost of selective refinement: splits forced by the paper's rule and by two earlier rules, for one base
/// vertex and for spheres; flipped faces, and the splits that repair them; splits per second and bytes; operations per
/// frame along a path. Prints the tables and writes them to `out` as CSV and Markdown, and four pictures of the last
/// model. All values except times are the same in every run. Throws Error.
void study_refinement(const RefinementStudyOptions& options);

} // namespace octant::ui::studies::refinement
