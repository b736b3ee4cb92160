#pragma once

#include "ui/commands/command.h"

namespace octant::ui::commands {

Command fly_command();
Command report_command();
Command terrain_command();
Command draw_order_command();
Command mesh_error_command();
Command refine_command();
Command simplify_command();
Command study_command();
Command bench_command();

/// All commands. `view`, the one that opens windows, is made by ui/window.
Program octant_program(Command view);

} // namespace octant::ui::commands
