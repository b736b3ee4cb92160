#pragma once

#include "ui/commands/command.h"

#include <filesystem>

namespace octant::ui::window {

/// The command that opens windows. It needs a display; Error where there is none.
commands::Command view_command();

/// The user's own folder for what windows keep; empty where there is none.
std::filesystem::path configuration_folder();

} // namespace octant::ui::window
