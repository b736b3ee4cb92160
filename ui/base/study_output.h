#pragma once

#include <filesystem>

namespace octant::ui::base {

/// Where a study leaves its tables, what it prints and whether it says how far it is.
struct StudyOutput {
    /// The folder for tables, figures and pictures.
    std::filesystem::path out;
    /// Print the tables as JSON instead of Markdown.
    bool json = false;
    bool quiet = false;
};

} // namespace octant::ui::base
