#pragma once

#include "ui/commands/option.h"

#include <functional>
#include <string>
#include <vector>

namespace octant::ui::commands {

/// Thrown by a command whose work is done and whose check said no: exit code 1, without a line.
struct CheckFailed {};

/// A command as the user meets it. What its options read into belongs to `run` and to them.
struct Command {
    std::string name;
    std::string summary;
    std::vector<Option> options = {};
    std::string footer = {}; ///< below the options in help: remarks, then examples
    /// Does the work, once all options are read. Throws Error when input or environment is wrong.
    std::function<void()> run = {};
    std::vector<Command> commands = {}; ///< one of them must follow; then there are no options
};

/// The whole program.
struct Program {
    std::string about;
    std::string version;
    std::string footer;
    std::vector<Command> commands;
};

} // namespace octant::ui::commands
