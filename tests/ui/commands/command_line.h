#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octant::tests {

/// What a run of the program left behind.
struct ProgramRun {
    int exit_code = -1; ///< 128 + signal when it was killed
    std::string out;
    std::string err;
};

/// Runs the octant program with these arguments (no shell) and waits.
ProgramRun run_octant(const std::vector<std::string>& arguments);

/// Starts it and sends it a signal once `file` is there, at the latest after two minutes.
ProgramRun run_octant_and_signal(
    const std::vector<std::string>& arguments, const std::filesystem::path& file, int signal);

/// Number of lines in a text.
int lines_in(const std::string& text);

} // namespace octant::tests
