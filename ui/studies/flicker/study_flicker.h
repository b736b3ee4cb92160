#pragma once

#include <filesystem>
#include <string>

namespace octant::ui::studies::flicker {

struct FlickerStudyOptions {
    std::filesystem::path out;
    std::string gentle = "hills";  ///< name or file, as load_height_field takes them
    std::string rugged = "canyon"; ///< name or file, as `gentle`
    double spacing_m = 30.0;       ///< of height files that name no spacing
    int frames = 1000;             ///< of the path; a fifth of them, at least 60, at a fixed view
    bool json = false;             ///< print the tables as JSON instead of Markdown
    bool quiet = false;
};

/// What E. K. Choi and B. S. Shin show about holding the number of triangles, over a gentle and a
/// rugged field: fixed view for c = 1, 2, 3, 5, a path at c = 5, damping over r, and settling from
/// any C at gains to 5, for the paper's controls, the exact budget and the default mesh; then the
/// controls over grounds from flats to high mountains. Prints the tables and writes them to `out` as
/// CSV and together as Markdown, dn of each frame of the path as CSV, and the paper's figures as
/// PNG. The same options give the same bytes. Throws Error.
void study_flicker(const FlickerStudyOptions& options);

} // namespace octant::ui::studies::flicker
