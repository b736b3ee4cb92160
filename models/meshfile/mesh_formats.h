#pragma once

#include "models/triangle_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// The readers behind read_mesh, one a format; all throw Error.
TriangleMesh read_obj_mesh(const std::filesystem::path& path);
TriangleMesh read_ply_mesh(const std::filesystem::path& path);

/// OBJ and MTL text of a mesh; `mtl_name` is what the OBJ text calls its material file (no mtllib
/// line without materials). Numbers have the digits that it takes to read them back bit for bit.
struct ObjMeshText {
    std::string obj;
    std::string mtl; ///< empty without materials
};

ObjMeshText obj_mesh_text(const TriangleMesh& mesh, std::string_view mtl_name);

/// A binary PLY file, little endian: coordinates in float where that changes none of them, else in
/// double; colours in uchar where that changes none, else in float; normals where each vertex has
/// one only; no materials.
std::string ply_bytes(const TriangleMesh& mesh);

} // namespace octant::models::meshfile
