#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::base {

/// Where the program's own models and paths lie: OCTANT_DATA when set, else the installed prefix
/// beside the program, else the source tree it was built from. Throws Error when none of them has
/// them, naming the places.
std::filesystem::path data_folder();

/// File of an aircraft: a built-in name (f15, 500md, concave) or a file. Throws Error for a name
/// that is neither, listing the built-in ones.
std::filesystem::path aircraft_file(const std::string& name_or_file);

/// File of a path for an aircraft: a built-in name (straight, jinking, pop-up, turn) or a file.
/// Aircraft other than the 500MD fly the F-15's paths. Throws Error as aircraft_file.
std::filesystem::path path_file(const std::string& name_or_file, const std::string& aircraft);

/// Built-in paths in the order of the 1989 paper.
std::vector<std::string> built_in_paths();

} // namespace octant::ui::base
