#pragma once

#include "models/heights/import_options.h"
#include "ui/base/output_options.h"

#include <string>

namespace octant::ui::studies::flicker {

/// Options of the study of the triangle controls.
struct FlickerStudyOptions : base::StudyOutput {
    std::string gentle = "hills";         ///< name or file, as load_height_field takes them
    std::string rugged = "canyon";        ///< name or file, as `gentle`
    models::heights::ImportOptions files; ///< what height files do not say
    int frames = 1000;                    ///< of the path; a fifth of them, at least 60, at a fixed view
};

/// Repeats the experiments of E. K. Choi and B. S. Shin on triangle count control over a gentle and a rugged field, for
/// the paper's controls, the exact budget and the default mesh: a fixed view with c = 1, 2, 3, 5; a path at c = 5;
/// damping as a function of r; settling from several C at gains up to 5. Then compares the controls over terrains from
/// flats to high mountains. Prints the tables and writes them to `out` as CSV and as one Markdown page, dn of each path
/// frame as CSV, and the paper's figures as PNG. The same options give the same bytes. Throws Error.
void study_flicker(const FlickerStudyOptions& options);

} // namespace octant::ui::studies::flicker
