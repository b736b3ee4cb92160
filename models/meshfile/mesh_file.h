#pragma once

#include "models/meshfile/mesh_parts.h"
#include "models/polygons/aircraft_shape.h"
#include "models/polygons/file_axes.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace octant::models::meshfile {

/// Reads a triangle mesh. The file's extension selects the format: .obj (with vertex colours), .ply (ASCII, binary of
/// both byte orders), .stl (ASCII, binary), .off (ASCII, read only), .gltf and .glb, .ac (AC3D), .wrl (VRML 2.0
/// IndexedFaceSet), .dnm and .srf (YSFlight, read only), X-Plane's OBJ8 in .obj files, .acf (an aircraft of X-Plane 10
/// and later, which names its objects; read only), .xml (a FlightGear model with its sub-models, or an aircraft's
/// -set.xml, which names its model; read only). Polygons are cut into triangles; repair::repaired makes further
/// changes. Scene nodes are placed, and mirrored nodes get their orientation back. Axes and units are those of the
/// file. Integer colours are scaled to 0..1. Colours are display values (models/material.h); the linear colours of glTF
/// are converted.
///
/// Texture coordinates and picture names are read from .obj, .ac, .wrl and glTF files, texture coordinates alone from
/// .ply and .off, pictures only if `options` ask for them. Ignored: lines, points, attributes that TriangleMesh does
/// not have, normals of STL, nodes of unknown types, and the back of two-sided surfaces unless `options` ask for it.
/// TriangleMesh::notes lists what was left out. A zero normal is replaced by the triangle's own.
///
/// Throws Error "file:line: expected ..., got ..." (binary files "file: at byte N: ...", glTF "file: nodes[3].mesh:
/// ..."), also for a file without triangles. Memory is bounded by the file's size (16 to 30 times for JSON and VRML): a
/// header that promises more than the file can contain is refused before memory is allocated, and scenes that repeat a
/// mesh are limited to 2^27 corners and vertices.
TriangleMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// As read_mesh, but returns transparent surfaces (.ac, .obj, glTF) and groups of objects (.ac) separately. With
/// pictures, triangles with a uniform or graded picture opacity of 0.05 to 0.5 are transparent too; other triangles whose picture
/// is mostly transparent, and invisible surfaces, are left out. Throws Error.
MeshParts read_parts(const std::filesystem::path& path, const ReadOptions& options);

/// As read_mesh, for the same files; only FlightGear's, X-Plane's and YSFlight's models have parts. Parts that are
/// hidden at rest, such as landing gear, are among these parts alone. Throws Error.
RotatingModel read_rotating_model(const std::filesystem::path& path, const ReadOptions& options);

/// Whether a file is an X-Plane object (OBJ8), by its first lines; false where it cannot be read.
bool is_xplane_object(const std::filesystem::path& path);

/// Writes a mesh in the format of the extension, completely or not at all: .obj with an .mtl file, binary .ply and
/// .stl, .gltf with embedded data, .glb, .ac, .wrl. read_mesh returns the same mesh within the limits of the format:
///     .obj        all; embedded pictures become files in the same folder
///     .ply        no materials; normals where each vertex has only one
///     .stl        positions in float; vertices in the order of their first corners, nothing else
///     .gltf .glb  positions in float, relative to the mesh's centre where it is far from 0 (the
///                 node's translation); colours of vertices to one step of a float; a vertex of
///                 several normals or texture coordinates becomes several; PNG and JPEG pictures
///     .ac         no colours of vertices, no normals; texture coordinates where all materials
///                 have one picture
///     .wrl        no texture coordinates; letters and digits of materials' names
/// With several materials .gltf, .glb and .wrl put triangles in the order of their materials; .obj, .gltf, .glb and .ac
/// lose materials that no triangle has. Throws Error.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// Lists what write_mesh would leave out in the format of the extension, one line each: "FILE: the format holds no ...,
/// which are left out".
std::vector<std::string> write_warnings(const std::filesystem::path& path, const TriangleMesh& mesh);

/// The largest rounding of a coordinate within `bounds` by write_mesh, metres; 0 for formats in double precision.
double rounding_m(const std::filesystem::path& path, const BoundingBox& bounds);

/// Whether read_mesh knows the extension.
bool is_mesh_file(const std::filesystem::path& path);

/// Whether write_mesh knows the extension.
bool is_writable_mesh_file(const std::filesystem::path& path);

/// The axes of aircraft in a file format that prescribes them, by the file's extension: AC3D x back, y up, z left (as
/// FlightGear uses it), YSFlight x left, y up, z forward, X-Plane objects x right, y up, z back, FlightGear models
/// (.xml) x back, y right, z up. Nothing for other formats.
std::optional<polygons::FileAxes> axes_of_format(const std::filesystem::path& file);

/// What is usual in a format that leaves the nose to its users: glTF has y up, and z forward in its specification
/// alone; Assimp hands over files with y up; OpenFlight and OpenSceneGraph have z up, mostly y forward; others have y
/// or z up.
std::vector<polygons::AxesHint> axes_hints_of_format(const std::filesystem::path& file);

} // namespace octant::models::meshfile
