#pragma once

#include "models/triangle_mesh.h"

#include <string>
#include <vector>

namespace octant::tests::formats {

/// What follows the reading of any mesh: its indices are looked at, and it is repaired. Throws Finding.
void use_mesh(const models::TriangleMesh& mesh);

/// The unit cube, with a colour a vertex, corner normals and two materials; a tetrahedron.
models::TriangleMesh sample_cube();
models::TriangleMesh sample_tetrahedron();

/// Both as files of a mesh format: ".ply".
std::vector<std::string> mesh_seeds(const std::string& ending);

} // namespace octant::tests::formats
