#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::tests::formats {

/// Checks a mesh that was read, repairs it and checks that the result is an oriented manifold. Throws Finding.
void use_mesh(const models::TriangleMesh& mesh);

/// Reads a mesh file with its pictures and back faces and uses the mesh.
void use_mesh_file(const std::filesystem::path& file);

/// The coloured cube, and a tetrahedron with a normal and a coordinate that is no float, as files of a mesh format:
/// ".ply".
std::vector<std::string> mesh_seeds(const std::string& ending);

/// A box with a wall beside it: 7 polygons that hide one another, and a part that turns.
models::polygons::PolygonModel small_model();

/// Eyes near and far, also in the middle of things.
std::vector<glm::dvec3> some_eyes();

} // namespace octant::tests::formats
