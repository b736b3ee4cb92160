#pragma once

#include "sim/aircraft_kind.h"

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

/// Names of the built-in models of polygons: those of the known aircraft, then concave.
std::vector<std::string> built_in_models();

/// The aircraft whose flight model and built-in paths a model flies with: its own, or, for concave
/// and files, of which no more than the shape is known, the F-15's. Throws Error as aircraft_file.
const sim::AircraftKind& flown_as(const std::string& name_or_file);

/// File of a path for an aircraft: a built-in name (straight, jinking, pop-up, turn), of which each
/// known aircraft has its own, or a file. Throws Error as aircraft_file.
std::filesystem::path path_file(const std::string& name_or_file, const std::string& aircraft);

/// Built-in paths in the order of the 1989 paper.
std::vector<std::string> built_in_paths();

} // namespace octant::ui::base
