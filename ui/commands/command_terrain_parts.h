#pragma once

#include "ui/commands/command.h"

#include <string>

namespace octant::ui::commands {

// Commands below `octant terrain` that have a file of their own.

Command terrain_import_command();
Command terrain_mesh_command();
Command terrain_error_command();
Command terrain_query_command();
Command terrain_check_command();

/// Shows the figures of a file made by import, after checking all of it where `verify`. Throws
/// Error for a damaged one.
void show_ground_file(const std::string& file, bool verify, bool json);

} // namespace octant::ui::commands
