#pragma once

#include "models/polygons/polygon_model.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace octant::models::polygons {

/// Materials of an MTL file in file order: `newmtl NAME` and its `Kd R G B`, taken as display values; a material
/// without Kd keeps the default colour, all other lines are ignored. Throws Error "file:line: expected ..., got ..."
/// for a Kd that is not three numbers 0..1 or that comes before any newmtl, for a name that is missing or comes twice,
/// and for a file that is not text.
std::vector<Material> read_mtl(const std::filesystem::path& path);

/// The pictures of an MTL file's materials, by the materials' names: what stands last in the lines `map_Kd ... FILE`.
/// Throws Error for a file that is not text.
std::map<std::string, std::string> pictures_of_mtl(const std::filesystem::path& path);

/// How much the materials of an MTL file hide of what lies behind, by their names, of those that do not hide all: `d`,
/// else 1 - `Tr`; no numbers 0..1 and a Tr of 1 say nothing, since programs disagree about it. Throws Error for a file
/// that is not text.
std::map<std::string, float> opacities_of_mtl(const std::filesystem::path& path);

} // namespace octant::models::polygons
