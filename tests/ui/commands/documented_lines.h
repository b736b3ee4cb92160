#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::tests {

/// Words of one command line behind the program's name.
using CommandLine = std::vector<std::string>;

/// The command lines of the octant program in a text, in their order: a line that begins with its name, without its
/// comment, cut where it says ; or &&.
std::vector<CommandLine> command_lines(std::string_view text);

/// The same of the ``` blocks of a Markdown file.
std::vector<CommandLine> command_lines_in_blocks(const std::filesystem::path& markdown);

/// The README files of the project, the one at the top first.
std::vector<std::filesystem::path> readme_files();

/// Makes a command line quick: few frames, small pictures and maps, few samples.
CommandLine shortened(CommandLine line);

/// Makes the files that a command line reads, where they are missing in the working folder: maps, meshes, paths,
/// tracks, recordings, all small. Throws where the program cannot make them.
void make_inputs(const CommandLine& line);

} // namespace octant::tests
