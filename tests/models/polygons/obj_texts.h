#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace octant::models::polygons::test {

/// A file of that name in the folder of this test run.
std::filesystem::path scratch(const std::string& name);

/// The model that read_obj makes of a text in the file m.obj.
PolygonModel model_of(const std::string& text, const FileAxes& axes = {});

/// What read_obj says about a text, without the folder before the file's name; or "accepted".
std::string message(const std::string& text);

/// The notes of a model without the folder before the file's name.
std::vector<std::string> notes_of(const PolygonModel& model);

/// Vertices 1 to 4 of a unit square.
inline const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Vertex indices of a polygon.
std::vector<std::uint32_t> corners(const PolygonModel& model, std::size_t polygon);

} // namespace octant::models::polygons::test
