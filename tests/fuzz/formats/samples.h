#pragma once

#include "models/polygons/polygon_model.h"
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

/// A box with a wall beside it: 7 polygons that hide one another, and a part that turns.
models::polygons::PolygonModel small_model();

/// Eyes near and far, also in the middle of things.
std::vector<glm::dvec3> some_eyes();

} // namespace octant::tests::formats
