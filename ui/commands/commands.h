#pragma once

#include "ui/commands/command.h"

#include <memory>
#include <vector>

namespace octant::ui::commands {

Command fly_command();
/// Prints what a program says of itself.
Command manual_command(std::shared_ptr<const Program> program);
Command pack_command();
Command report_command();
Command terrain_command();
Command draw_order_command();
Command mesh_error_command();
Command model_command();
Command refine_command();
Command simplify_command();
Command sweep_command();
Command study_command();
Command bench_command();

/// All commands. Those that open windows are made by ui/window.
Program octant_program(std::vector<Command> window_commands);

} // namespace octant::ui::commands
