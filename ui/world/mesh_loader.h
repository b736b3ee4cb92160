#pragma once

#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_join.h"
#include "models/triangle_mesh.h"
#include "visuals/refine/mesh_creases.h"
#include "visuals/refine/mesh_textures.h"
#include "visuals/refine/progressive_mesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Names that load_mesh() takes, as help lists them: "globe, torus, ...".
std::string built_in_mesh_names();

/// A triangle mesh by one of these names or from a file, not repaired. Throws Error.
models::TriangleMesh load_mesh(const std::string& name_or_file, const models::meshfile::ReadOptions& options = {});

/// The same with turning parts and transparent surfaces apart, where the file's reader tells them. Throws Error.
models::meshfile::RotatingModel load_rotating_model(
    const std::string& name_or_file, const models::meshfile::ReadOptions& options = {});

/// Whether a file's ending is one that a library's reader takes: Assimp's or OpenSceneGraph's.
bool is_library_file(const std::filesystem::path& file);

/// Reads a mesh by a library in a process of its own, with limits of time (25 s) and memory (4 GiB). Of the options
/// `pictures`, `textures` and `backs` count. Throws Error "file: ..." in one line, also where the library crashes and
/// where the program was built without it.
models::TriangleMesh read_library_mesh(
    const std::filesystem::path& file, const models::meshfile::ReadOptions& options = {});

/// The endings that this build reads by libraries, a line a library, for octant --version.
std::string library_formats();

// Vertex hierarchies for refinement in flight.

struct RefineMeshOptions {
    /// A triangle mesh or a progressive mesh (.pm).
    std::string file;
    /// Of meshes: the least number of vertices of the base mesh; 0 = as few as possible.
    std::size_t base = 0;
    /// The most vertices that are read of a .pm file.
    std::size_t max_vertices = std::numeric_limits<std::size_t>::max();
    bool quiet = false;
};

/// A hierarchy, with notes for the user.
struct RefineMesh {
    std::shared_ptr<const visuals::refine::ProgressiveMesh> mesh;
    /// The pictures and plain colours on it; null unless its materials have textures or several colours.
    std::shared_ptr<const visuals::refine::MeshTextures> textures;
    /// For each chart of `textures` its material in the mesh.
    std::vector<std::uint32_t> chart_materials;
    /// Null where each vertex has one normal, and for a hierarchy from a file.
    std::shared_ptr<const visuals::refine::MeshCreases> creases;
    std::vector<std::string> notes;
    /// Changes made by repair, a line each; also in the notes, after the name of the file.
    std::vector<std::string> repairs;
    /// True if the mesh has no vertex colours: the hierarchy then has its materials' colours, or grey.
    bool has_material_colours = false;
};

/// Reads, or makes by repair and simplification, a hierarchy. Throws Error.
RefineMesh read_refine_mesh(const RefineMeshOptions& input);

/// Makes a hierarchy of a mesh that has been read from the input's file. Throws Error.
RefineMesh make_refine_mesh(const RefineMeshOptions& input, models::TriangleMesh mesh);

/// File of `folder` in which the hierarchy of a mesh is cached, named by two hashes of its places, triangles, colours
/// and materials.
std::filesystem::path refine_mesh_cache_file(const std::filesystem::path& folder, const models::TriangleMesh& mesh);

/// As make_refine_mesh(), but read from the cache in `folder` if the same mesh was made before, else made and written
/// there. Hierarchy and notes are the same either way. A damaged file is replaced, with a note. Processes may share a
/// folder: files appear whole.
RefineMesh cached_refine_mesh(
    const std::filesystem::path& folder, const RefineMeshOptions& input, models::TriangleMesh mesh);

/// Reads or makes a hierarchy as read_refine_mesh does, and prints its notes to stderr. Throws Error.
RefineMesh load_refine_mesh(const RefineMeshOptions& input);

} // namespace octant::ui::world
