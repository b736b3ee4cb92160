#pragma once

#include "ui/command_line/command.h"

#include <string>

namespace octant::ui::command_line {

// Help, wrapped to the width of the terminal (COLUMNS, else that of standard output, else 80).

/// What the program does, its commands and its footer.
std::string program_help(const Program& program);

/// Usage, options under their headings and footer of a command. `before`: the words before its name. `all` adds the
/// options that only --help-all shows.
std::string command_help(const Command& command, const std::string& before, bool all);

} // namespace octant::ui::command_line
