#pragma once

#include "models/meshfile/read_options.h"
#include "models/triangle_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::models::meshfile {

/// Reads a triangle mesh; the file's ending says its format: .obj (with vertex colours), .ply (ascii, binary of both
/// byte orders), .stl (ascii, binary), .off (ascii, read only), .gltf and .glb, .ac (AC3D), .wrl (VRML 2.0
/// IndexedFaceSet), .xml (FlightGear's model with its sub-models, or an aircraft's
/// -set.xml, which names its model; read only). Polygons are cut into triangles; nothing else is
/// changed: see repair.h. Scenes are read as they stand (nodes placed, mirrored ones turned round again), axes and
/// units as the file has them. Whole-number colours stand for 0..1. Colours are display values (models/material.h);
/// those of glTF, linear in its files, are converted.
///
/// Texture coordinates and the names of materials' pictures are read from .obj, .ac and glTF files, texture coordinates
/// alone from .ply and .off; pictures themselves only as `options` say. Left out, where a file has it: lines and
/// points, attributes that a mesh does not have, texture coordinates of VRML, normals of STL, inner nodes of unknown
/// kinds; of two-sided surfaces the back but for `options`. TriangleMesh::notes says what may be missed. A normal
/// without a length becomes its triangle's own.
///
/// Throws Error "file:line: expected ..., got ..." (binary files "file: at byte N: ...", glTF "file: nodes[3].mesh:
/// ..."), also for a file without triangles. Memory is bounded by the file's size (16 to 30 times that for JSON and
/// VRML): a header that promises more than the file can hold is refused before anything is made room for, scenes that
/// show one thing again and again end at 2^27 corners and vertices.
TriangleMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Writes a mesh in the format that the ending says, whole or not at all: .obj with .mtl beside it, .ply and .stl
/// binary, .gltf with its data inside, .glb, .ac, .wrl. read_mesh gives the same mesh as far as the format holds it:
///     .obj        all; pictures inside the mesh's former file become files beside it
///     .ply        no materials; normals where each vertex has only one
///     .stl        places in float; vertices in the order of their first corners, nothing else
///     .gltf .glb  places in float, from the middle of the mesh where it is far from 0 (the
///                 node's translation); colours of vertices to one step of a float; a vertex of
///                 several normals or texture coordinates becomes several; PNG and JPEG pictures
///     .ac         no colours of vertices, no normals; texture coordinates where all materials
///                 have one picture
///     .wrl        no texture coordinates; letters and digits of materials' names
/// With several materials .gltf, .glb and .wrl put triangles in the order of their materials; .obj, .gltf, .glb and .ac
/// lose materials that no triangle has. Throws Error.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// What write_mesh leaves out of a mesh in the format that the ending says, a line each: "FILE: the format holds no
/// ..., which are left out". Empty where the file holds all.
std::vector<std::string> write_warnings(const std::filesystem::path& path, const TriangleMesh& mesh);

/// No coordinate within `bounds` moves farther than this when write_mesh rounds it, metres: 0 where the format keeps
/// double precision.
double rounding_m(const std::filesystem::path& path, const BoundingBox& bounds);

/// Whether read_mesh knows the ending.
bool is_mesh_file(const std::filesystem::path& path);

/// Whether write_mesh knows it, too.
bool is_writable_mesh_file(const std::filesystem::path& path);

} // namespace octant::models::meshfile
