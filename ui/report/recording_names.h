#pragma once

#include <string_view>

namespace octant::ui::report {

/// True for the names that a recording gives its files and folders, and for what a kill left of writing one.
bool is_recording_name(std::string_view name);

} // namespace octant::ui::report
