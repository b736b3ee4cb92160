#pragma once

#include "ui/command_line/command.h"

#include <vector>

namespace octant::ui::window {
struct ViewOptions;
}

namespace octant::ui::commands {

// One function for each command, in command_NAME.cpp.
command_line::Command compare_command();
command_line::Command dataset_command();
command_line::Command draw_order_command();
command_line::Command fly_command();
command_line::Command listen_command();
command_line::Command mesh_error_command();
command_line::Command model_command();
command_line::Command pack_command();
command_line::Command refine_command();
command_line::Command report_command();
command_line::Command simplify_command();
command_line::Command sweep_command();
command_line::Command terrain_command();
command_line::Command track_command();
command_line::Command view_command();

/// Adds the option --window of view and listen, with `more` keys at its end.
void add_window_options(std::vector<command_line::Option>& table, window::ViewOptions& view,
    const std::vector<command_line::FamilyKey>& more = {});

/// The program octant: its commands in the order of help.
command_line::Program octant_program();

} // namespace octant::ui::commands
