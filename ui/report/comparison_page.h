#pragma once

#include "ui/report/loaded_recording.h"

#include <filesystem>
#include <span>
#include <string>

namespace octant::ui::report {

/// What a page says of several recordings together: a table with one row each, comparisons among
/// those of the same flight, their curves in common plots, a small plot each with common axes,
/// pictures, and the settings that all share. A recording whose own page lies in its folder is
/// linked from `page_folder`.
std::string several_recordings_html(Recordings recordings, const std::filesystem::path& page_folder);

} // namespace octant::ui::report
