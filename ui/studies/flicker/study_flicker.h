#pragma once

#include "models/heights/import_options.h"
#include "ui/base/study_output.h"

#include <string>

namespace octant::ui::studies::flicker {

/// What the study of the triangle controls runs over.
struct FlickerStudyOptions : base::StudyOutput {
    std::string gentle = "hills";         ///< name or file, as load_height_field takes them
    std::string rugged = "canyon";        ///< name or file, as `gentle`
    models::heights::ImportOptions files; ///< what height files do not say
    int frames = 1000;                    ///< of the path; a fifth of them, at least 60, at a fixed view
};

/// What E. K. Choi and B. S. Shin show about holding the number of triangles, over a gentle and a rugged field: fixed
/// view for c = 1, 2, 3, 5, a path at c = 5, damping over r, and settling from any C at gains to 5, for the paper's
/// controls, the exact budget and the default mesh; then the controls over grounds from flats to high mountains. Prints
/// the tables and writes them to `out` as CSV and together as Markdown, dn of each frame of the path as CSV, and the
/// paper's figures as PNG. The same options give the same bytes. Throws Error.
void study_flicker(const FlickerStudyOptions& options);

} // namespace octant::ui::studies::flicker
