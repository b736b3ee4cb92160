#pragma once

namespace CLI {
class App;
}

namespace octant::ui::commands {

/// Thrown by a callback when its work is done and a check said no: exit code 1, without a line.
struct CheckSaidNo {};

// Each adds one sub-command whose callback does the work. A callback throws Error when input or
// environment is wrong.

void add_fly_command(CLI::App& program);
void add_view_command(CLI::App& program); ///< in ui/window; needs a display
void add_report_command(CLI::App& program);
void add_terrain_command(CLI::App& program);
void add_draw_order_command(CLI::App& program);
void add_mesh_error_command(CLI::App& program);
void add_refine_command(CLI::App& program);
void add_simplify_command(CLI::App& program);
void add_study_command(CLI::App& program);
void add_bench_command(CLI::App& program);

} // namespace octant::ui::commands
