#pragma once

#include "models/meshfile/mesh_file.h"
#include "models/triangle_mesh.h"

#include <string>

namespace octant::ui::world {

/// Names that load_mesh takes, as help lists them: "globe, torus, ...".
std::string built_in_mesh_names();

/// A triangle mesh by one of these names or from a file, not repaired. Throws Error.
models::TriangleMesh load_mesh(const std::string& name_or_file, const models::meshfile::ReadOptions& options = {});

} // namespace octant::ui::world
