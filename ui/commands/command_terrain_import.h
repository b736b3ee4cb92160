#pragma once

#include <string>

namespace CLI {
class App;
}

namespace octant::ui::commands {

/// Adds `import` to the terrain command.
void add_terrain_import(CLI::App& terrain);

/// Shows the figures of a file made by import, after checking all of it where `verify`. Throws
/// Error for a damaged one.
void show_ground_file(const std::string& file, bool verify, bool json);

} // namespace octant::ui::commands
