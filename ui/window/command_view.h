#pragma once

namespace CLI {
class App;
}

namespace octant::ui {

/// Adds the sub-command that opens a window. Its callback throws Error without a display.
void add_view_command(CLI::App& program);

} // namespace octant::ui
