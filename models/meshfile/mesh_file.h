#pragma once

#include "models/triangle_mesh.h"

#include <filesystem>

namespace octant::models::meshfile {

/// Reads a triangle mesh; the file's ending says its format: .obj (with vertex colours), .ply
/// (ascii, binary of both byte orders), .stl (ascii, binary), .gltf and .glb, .ac (AC3D), .wrl
/// (VRML 2.0 IndexedFaceSet). Polygons are cut into triangles; nothing else is changed: see
/// repair.h. Throws Error "file:line: expected ..., got ..." (binary files: "file: ... at byte
/// N"). Memory is bounded by the file's size: a header that promises more than the file can hold
/// is refused before anything is made room for.
TriangleMesh read_mesh(const std::filesystem::path& path);

/// Writes a mesh in the format that the ending says, whole or not at all: .obj with .mtl beside it,
/// .ply and .stl binary, .gltf with its data inside, .glb, .ac, .wrl. read_mesh gives the same mesh
/// as far as the format holds it (STL: no shared vertices, no colours). Throws Error.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// Whether read_mesh knows the ending.
bool is_mesh_file(const std::filesystem::path& path);

} // namespace octant::models::meshfile
