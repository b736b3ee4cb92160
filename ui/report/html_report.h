#pragma once

#include "ui/report/loaded_recording.h"
#include "ui/report/table.h"

#include <filesystem>
#include <span>
#include <string>

namespace octant::ui::report {

/// A self-contained page on one recording or on several. The page on one has its figures with their definitions, plots
/// over simulated time with the path's legs, pictures, its slowest frames and why, settings and machine. `first_tables`
/// come first. Nothing is fetched when it is read; its own script draws the plots. `page_folder` is where the page will
/// lie, for links.
std::string html_report(Recordings recordings, std::span<const ResultTable> first_tables = {},
    const std::filesystem::path& page_folder = {});

} // namespace octant::ui::report
