#pragma once

#include "models/triangle_mesh.h"
#include "tests/sample_meshes.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace octant::models::meshfile::test {

/// A path in the scratch folder of this test program; a file of that name is removed first.
std::filesystem::path scratch_file(const std::string& name);

/// scratch_file with this content.
std::filesystem::path file_with(const std::string& name, std::string_view content);

/// An AC3D file with one square in x and y, over which the picture two.bmp lies; `flags` as its SURF line has them.
std::string ac3d_square(const std::string& flags, const std::string& name = "square");

/// What reading a file of this name and content says; empty when it is read. The path's folder is left out.
std::string error_of(const std::string& name, std::string_view content);

/// Checks that everything two meshes hold is the same.
void check_same(const TriangleMesh& a, const TriangleMesh& b);

/// A large real file, if this computer has it. Prints "SKIPPED: why" when it has not.
std::optional<std::filesystem::path> real_mesh_file(const std::string& name);

} // namespace octant::models::meshfile::test
