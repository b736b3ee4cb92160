#pragma once

#include "models/meshfile/mesh_file.h"
#include "models/triangle_mesh.h"

#include <string>

namespace octant::ui::world {

/// A triangle mesh by name (globe, torus, machined-part, f15, 500md, concave) or from a file, not
/// repaired. Throws Error.
models::TriangleMesh
read_mesh_input(const std::string& name_or_file, const models::meshfile::ReadOptions& options = {});

} // namespace octant::ui::world
