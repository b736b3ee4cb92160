#pragma once

#include "ui/commands/command.h"

#include <string>

namespace octant::ui::commands {

/// The program's manual as a page of section 1 in man's macros: every command with its options, their units and
/// defaults, and its examples.
std::string man_page(const Program& program);

/// What completes command lines in bash, zsh too (by its bashcompinit): commands and options; files for everything
/// else.
std::string bash_completion(const Program& program);
std::string zsh_completion(const Program& program);

} // namespace octant::ui::commands
