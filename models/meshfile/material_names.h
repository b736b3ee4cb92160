#pragma once

#include "models/polygons/polygon_model.h"

#include <span>
#include <string>
#include <vector>

namespace octant::models::meshfile {

/// Names of materials as text formats can hold them: not empty, one line, no quotes, none twice.
std::vector<std::string> unique_material_names(std::span<const Material> materials);

} // namespace octant::models::meshfile
