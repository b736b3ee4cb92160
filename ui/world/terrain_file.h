#pragma once

#include "models/heights/height_field.h"

#include <string>

namespace octant::ui::world {

/// A height field by name: hills, canyon, or a file that GDAL reads. `spacing_m`: of files that do
/// not say. Throws Error for a name that is neither, listing the built-in ones.
models::heights::HeightField load_height_field(const std::string& name_or_file, double spacing_m);

} // namespace octant::ui::world
