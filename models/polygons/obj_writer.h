#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace octant::models::polygons {

/// A model as the texts of an OBJ file and of its MTL file.
struct ObjText {
    std::string obj;
    std::string mtl;
};

/// Writes a model in the file's axes; `mtl_name` is what the OBJ text calls its material file. Numbers have as many
/// digits as it takes to read them back bit for bit: read_obj returns the same model (a model whose parts and materials
/// come in the order of their first polygon, as read_obj makes them; others come back in that order).
ObjText obj_text(const PolygonModel& model, const FileAxes& axes, std::string_view mtl_name);

/// Writes the OBJ file and, beside it, the MTL file of the same name. Throws Error.
void write_obj(const std::filesystem::path& path, const PolygonModel& model, const FileAxes& axes = {});

} // namespace octant::models::polygons
