#pragma once

#include "models/meshfile/mesh_join.h"
#include "models/part_motion.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace octant::models::meshfile {

class TextureStore;

/// Options of read_mesh, read_parts and read_rotating_model.
struct ReadOptions {
    /// Reads the texture pictures of .ac, .obj, .wrl and glTF files and computes vertex colours from them: the mean
    /// around each vertex times the material colour. Not for meshes with vertex colours. Leaves out triangles whose
    /// picture is mostly transparent (ground shadows, turning propellers, clear glass), unless all triangles are.
    bool pictures = false;
    /// Keeps the pictures of surfaces for drawing (Material::texture): a material for each picture that lies on its
    /// triangles, and texture coordinates. Needs `pictures`. Triangles with holes in their picture stay then, and
    /// surfaces are transparent only where both material and picture are counted. Null: materials have no textures.
    std::shared_ptr<TextureStore> textures = {};
    /// Folder searched for pictures before the mesh's own folder; empty: only that one.
    std::filesystem::path pictures_in = {};
    /// Adds back faces to two-sided sheets of .ac and glTF files (repair::add_back_faces).
    bool backs = false;
    /// Reads objects of .ac files whose names say that they are no surface (propeller discs, light cones, ground
    /// shadows). They are read anyway if the file has nothing else.
    bool placeholders = true;
    /// Names of .ac objects to leave out, with their child objects.
    std::set<std::string> excluded = {};
    /// Transforms of .ac objects and their children, by object name; axes of the file. A child's own transform is
    /// applied before its parent's.
    std::map<std::string, AffineTransform> moved = {};
    /// Pictures of .ac objects and their children in place of those that they name, by object name; "" = of all others.
    std::map<std::string, std::string> repainted = {};
    /// Groups of .ac objects, by name and with their children, that read_parts returns as separate meshes. The
    /// outermost of nested objects and the first of several groups decide.
    std::vector<std::set<std::string>> groups = {};
};

/// A mesh in separate parts, any of which may be empty.
struct MeshParts {
    TriangleMesh body;                ///< also has the notes of all parts
    std::vector<TriangleMesh> groups; ///< as ReadOptions::groups
    TriangleMesh clear;               ///< transparent surfaces, such as the glass of canopies: Material::opacity
};

/// The axis of a rotation in flight; file axes, metres.
struct RotationAxis {
    glm::dvec3 point_m{0.0};
    glm::dvec3 direction{1.0, 0.0, 0.0}; ///< unit; positive turns follow the right-hand rule
    double turns_per_s = 0.0;
};

/// A part that turns by time, such as a propeller, or that controls move, such as a rudder, or both.
struct RotatingPart {
    TriangleMesh mesh;  ///< as at time 0 and at rest
    RotationAxis about; ///< 0 turns where it does not turn by time
    /// They move what `about` has turned. File axes.
    PartMoves moves = {};
};

/// A model with its rotating parts and its transparent surfaces as separate meshes.
struct RotatingModel {
    TriangleMesh body; ///< never empty
    std::vector<RotatingPart> parts;
    TriangleMesh clear; ///< as MeshParts
};

} // namespace octant::models::meshfile
