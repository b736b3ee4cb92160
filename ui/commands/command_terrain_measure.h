#pragma once

namespace CLI {
class App;
}

namespace octant::ui::commands {

// What `octant terrain` measures and asks of a ground. Each adds its sub-command to `terrain`.

void add_terrain_mesh(CLI::App& terrain);
void add_terrain_error(CLI::App& terrain);
void add_terrain_query(CLI::App& terrain);
void add_terrain_check(CLI::App& terrain);

} // namespace octant::ui::commands
