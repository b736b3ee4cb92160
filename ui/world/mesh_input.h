#pragma once

#include "models/meshfile/mesh_file.h"
#include "models/triangle_mesh.h"

#include <string>

namespace octant::ui::world {

/// Names that read_mesh_input takes, as help lists them: "globe, torus, ...".
std::string built_in_meshes();

/// A triangle mesh by one of these names or from a file, not repaired. Throws Error.
models::TriangleMesh
read_mesh_input(const std::string& name_or_file, const models::meshfile::ReadOptions& options = {});

} // namespace octant::ui::world
