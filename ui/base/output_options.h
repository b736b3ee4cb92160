#pragma once

#include <filesystem>

namespace octant::ui::base {

/// What almost every command lets its user choose about its output.
struct OutputOptions {
    bool json = false;  ///< results on standard output as JSON
    bool quiet = false; ///< neither progress nor notes on standard error
};

/// Output of a study.
struct StudyOutput : OutputOptions {
    std::filesystem::path out; ///< folder for tables, figures and pictures
};

} // namespace octant::ui::base
