#pragma once

#include "ui/command_line/option.h"

#include <functional>
#include <string>
#include <vector>

namespace octant::ui::command_line {

/// Thrown when a check fails after the command has printed its results: exit code 1, no message.
struct CheckFailed {};

/// One command of a program. `run` and the options share what the options read into.
struct Command {
    std::string name;
    std::string summary;
    std::vector<Option> options = {};
    std::string footer = {}; ///< below the options in help: remarks, then examples
    /// Does the work after all options are read. Throws Error for invalid input or environment.
    std::function<void()> run = {};
    std::vector<Command> commands = {}; ///< one of them must follow; then there are no options
    /// Not empty: the first words of the command line that does the work, such as {"octant-study", "bench"}. The words
    /// that follow the command's name are appended. The program is in the folder of this one or in PATH.
    Words program = {};
};

/// A whole program.
struct Program {
    std::string name; ///< "octant"
    std::string about;
    std::string version;
    std::string footer;
    std::vector<Command> commands; ///< in the order of help
};

} // namespace octant::ui::command_line
