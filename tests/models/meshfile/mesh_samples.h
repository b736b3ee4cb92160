#pragma once

#include "models/triangle_mesh.h"
#include "tests/sample_meshes.h"
#include "tests/scratch.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace octant::models::meshfile::test {

using tests::scratch_file;

/// scratch_file with this content.
std::filesystem::path file_with(const std::string& name, std::string_view content);

/// An AC3D file with one square in x and y, over which the picture two.bmp lies; `flags` as its SURF line has them.
std::string ac3d_square(const std::string& flags, const std::string& name = "square");

/// What reading a file of this name and content says; empty when it is read. The path's folder is left out.
std::string error_of(const std::string& name, std::string_view content);

/// Checks that everything two meshes hold is the same.
void check_same(const TriangleMesh& a, const TriangleMesh& b);

} // namespace octant::models::meshfile::test
