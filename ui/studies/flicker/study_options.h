#pragma once

#include "models/heights/import_options.h"
#include "ui/base/study_output.h"

#include <string>

namespace octant::ui::studies::flicker {

/// What the study of the triangle controls runs over.
struct FlickerStudyOptions : base::StudyOutput {
    std::string gentle = "hills";  ///< name or file, as load_height_field takes them
    std::string rugged = "canyon"; ///< name or file, as `gentle`
    models::heights::ImportOptions files; ///< what height files do not say
    int frames = 1000;             ///< of the path; a fifth of them, at least 60, at a fixed view
};

} // namespace octant::ui::studies::flicker
