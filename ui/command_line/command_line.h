#pragma once

#include "ui/command_line/command.h"

#include <functional>

namespace octant::ui::command_line {

/// What a command line asks for, ready to be done: the command that it names, with its options read already, or help.
/// `arguments` begin with the program's own name, as in main(). Throws Error with one line for a wrong command line.
std::function<void()> parse_command_line(const Program& program, int argument_count, const char* const* arguments);

/// Replaces this process by the program that the first word names, from the folder of this program or from PATH. Throws
/// Error if it is not found or cannot be started.
[[noreturn]] void replace_by_program(Words words);

/// The body of main() of the program `name`, whose commands `make_program` returns: does what the command line asks for
/// and returns the exit code. 0: success. 1: a check failed. 3: a comparison cannot tell. 2: invalid input or environment; the error is one line on
/// stderr. A received stop signal ends the process instead.
int run_program(const char* name, Program (*make_program)(), int argument_count, const char* const* arguments);

} // namespace octant::ui::command_line
