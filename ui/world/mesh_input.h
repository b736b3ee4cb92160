#pragma once

#include "models/triangle_mesh.h"

#include <string>

namespace octant::ui::world {

/// A triangle mesh by name (globe, torus, machined-part, f15, 500md, concave) or from a file, not
/// repaired. Throws Error.
models::TriangleMesh read_mesh_input(const std::string& name_or_file);

} // namespace octant::ui::world
