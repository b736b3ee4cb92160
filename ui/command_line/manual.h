#pragma once

#include "ui/command_line/command.h"

namespace octant::ui::command_line {

/// The command "manual": prints the manual page of `program`, or a script that completes its command lines in bash or
/// zsh.
Command manual_command(const Program& program);

} // namespace octant::ui::command_line
