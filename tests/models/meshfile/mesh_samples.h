#pragma once

#include "models/triangle_mesh.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace octant::models::meshfile::test {

/// A path in the scratch folder of this test program; a file of that name is removed first.
std::filesystem::path scratch_file(const std::string& name);

/// scratch_file with this content.
std::filesystem::path file_with(const std::string& name, std::string_view content);

/// What reading a file of this name and content says; empty when it is read. The path's folder is
/// left out.
std::string error_of(const std::string& name, std::string_view content);

/// The unit cube: 8 vertices, 12 triangles, outwards.
TriangleMesh cube();

/// The cube with a colour a vertex (parts of n/255), six corner normals and two materials.
TriangleMesh coloured_cube();

/// Four triangles.
TriangleMesh tetrahedron();

/// Checks that everything two meshes hold is the same.
void check_same(const TriangleMesh& a, const TriangleMesh& b);

/// What is wrong with a mesh's indices and lists; empty for a sound one.
std::string index_fault(const TriangleMesh& mesh);

/// Why a mesh is no oriented manifold (perhaps with boundary); empty when it is one. Slow and
/// simple: apart from the code that makes manifolds.
std::string manifold_fault(const TriangleMesh& mesh);

/// A large real file, if this computer has it. Prints "SKIPPED: why" when it has not.
std::optional<std::filesystem::path> real_mesh_file(const std::string& name);

} // namespace octant::models::meshfile::test
