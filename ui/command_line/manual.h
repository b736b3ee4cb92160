#pragma once

#include "ui/command_line/command.h"

#include <string>

namespace octant::ui::command_line {

/// The program's manual as a page of section 1 in man's macros: every command with its options, their units and
/// defaults, and its examples.
std::string man_page(const Program& program);

/// What completes command lines in bash, zsh too (by its bashcompinit): commands and options; files for everything
/// else.
std::string bash_completion(const Program& program);
std::string zsh_completion(const Program& program);

/// The command "manual": prints these for the other commands of `program`.
Command manual_command(const Program& program);

} // namespace octant::ui::command_line
