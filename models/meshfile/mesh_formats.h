#pragma once

#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_parts.h"
#include "models/part_motion.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

/// Names of materials as text formats can hold them: not empty, one line, no quotes, none twice.
std::vector<std::string> unique_material_names(std::span<const Material> materials);

/// The readers behind read_mesh and read_parts, one a format: all of the file, to be finished. Throw Error.
MeshBuilder read_obj(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_ply(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_stl(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_off(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_gltf(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_ac3d(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_srf(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_dnm(const std::filesystem::path& path, const ReadOptions& options);
MeshBuilder read_vrml(const std::filesystem::path& path, const ReadOptions& options);

/// The names of the objects in an AC3D file, whose shapes are not read: before read_ac3d, whose options name objects.
/// Throws Error.
std::set<std::string> ac3d_object_names(const std::filesystem::path& path);

/// A variable of a simulator that follows a control: its value is `scale` times the control's position.
struct ControlledVariable {
    std::string_view name; ///< that part of it by which it is known
    FlightControl control = FlightControl::Roll;
    double scale = 1.0;
    double right_scale = scale; ///< of the elements with odd numbers of a list, which lie on the right
};

/// Whether a text begins as an X-Plane object does.
bool is_xplane_text(std::string_view text);

/// An X-Plane object (OBJ8) with this text. Throws Error.
MeshBuilder read_xplane(const std::filesystem::path& path, std::string_view text, const ReadOptions& options);

/// The readers behind read_rotating_model: FlightGear's .xml, YSFlight's .dnm, X-Plane's .obj and .acf. Throw Error.
RotatingModel read_flightgear_model(const std::filesystem::path& path, const ReadOptions& options);
RotatingModel read_rotating_dnm(const std::filesystem::path& path, const ReadOptions& options);
RotatingModel read_rotating_xplane(const std::filesystem::path& path, const ReadOptions& options);
RotatingModel read_xplane_aircraft(const std::filesystem::path& path, const ReadOptions& options);

/// OBJ and MTL text of a mesh; `mtl_name` is what the OBJ text calls its material file (no mtllib line without
/// materials). Numbers have the digits that it takes to read them back bit for bit.
struct ObjMeshText {
    std::string obj;
    std::string mtl; ///< empty without materials
};

ObjMeshText obj_mesh_text(const TriangleMesh& mesh, std::string_view mtl_name);

/// A binary PLY file, little endian: coordinates in float where that changes none of them, else in double; colours in
/// uchar where that changes none, else in float; normals where each vertex has one only; texture coordinates of
/// vertices (s, t) where each has one only, else of faces (list texcoord); no materials.
std::string ply_bytes(const TriangleMesh& mesh);

/// Whether each vertex has one normal only, so that a PLY file holds the normals.
bool has_vertex_normals(const TriangleMesh& mesh);

/// A binary STL file: coordinates in float, one normal a triangle, nothing else.
std::string stl_bytes(const TriangleMesh& mesh);

/// The origin of the coordinates in a glTF file, the translation of its node: 0 where the bounding box is near it, else
/// a point in the middle of the box with coordinates in float, so that coordinates lose fewer digits.
glm::dvec3 gltf_origin_m(const BoundingBox& bounds);

/// The encoded picture of a material, from its file where it stands in one; null where it has none that can be read.
std::shared_ptr<const std::string> picture_bytes_of(const Material& material);

/// Whether the bytes are of a picture that glTF files may hold: PNG or JPEG.
bool is_gltf_picture(std::string_view bytes);

/// glTF 2.0 with its data inside, as JSON text or as a binary file: coordinates and colours (linear in light, as glTF
/// has them) in float, a primitive a material. A vertex of several normals or texture coordinates is written once for
/// each. PNG and JPEG pictures are written into the file.
std::string gltf_text(const TriangleMesh& mesh);
std::string glb_bytes(const TriangleMesh& mesh);

/// AC3D: places, materials and texture coordinates, no colours of vertices, no normals; the picture where there is one
/// only.
std::string ac3d_text(const TriangleMesh& mesh);

/// The picture that all materials with a picture have; empty where they have several or none.
std::string single_picture(const TriangleMesh& mesh);

/// VRML 2.0, without texture coordinates: an IndexedFaceSet a material, triangles therefore in the order of their
/// materials.
std::string vrml_text(const TriangleMesh& mesh);

} // namespace octant::models::meshfile
