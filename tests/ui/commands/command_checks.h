#pragma once

#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"

#include <string>
#include <utility>
#include <vector>

namespace octant::tests {

/// Runs `octant COMMAND ARGUMENTS --json --quiet`, which must say nothing but its figures.
PrintedJson results_of_run(const std::string& command, std::vector<std::string> arguments);

/// Checks that a run ended with code 2 and one line that has `expected` in it.
void check_refusal(const ProgramRun& run, const std::string& expected);

/// Command lines, with one blank between their words, and what the line that refuses each must contain.
using Refusals = std::vector<std::pair<std::string, std::string>>;

/// Checks that `octant COMMAND LINE --quiet` is refused (check_refusal) for each line.
void check_refusals(const std::string& command, const Refusals& refusals);

/// Checks that `octant COMMAND ARGUMENTS --quiet` is refused (check_refusal).
void check_refused(const std::string& command, std::vector<std::string> arguments, const std::string& expected);

} // namespace octant::tests
