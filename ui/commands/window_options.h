#pragma once

#include "ui/command_line/option.h"
#include "ui/window/viewer.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace octant::ui::commands {

/// Adds the option --window of view and listen. `recordings` receives the folder of recordings and screenshots; null if
/// the command has none.
void add_window_options(
    std::vector<command_line::Option>& table, window::ViewOptions& view, std::filesystem::path* recordings);

/// Shows frames in the window until it is closed, a stop signal comes or `frames` are shown. Completes the recording.
void run_viewer(window::Viewer& viewer, const std::optional<int>& frames, bool quiet);

} // namespace octant::ui::commands
