#pragma once

#include "ui/commands/command.h"

#include <functional>

namespace octant::ui::commands {

/// What a command line asks for, ready to be done: the command that it names, with its options read
/// already, or help. `arguments` begin with the program's own name, as in main(). Throws Error with
/// one line for a wrong command line.
std::function<void()>
parse_command_line(const Program& program, int argument_count, const char* const* arguments);

} // namespace octant::ui::commands
