#pragma once

#include "models/triangle_mesh.h"
#include "ui/world/refine_mesh.h"

#include <filesystem>

namespace octant::ui::world {

/// Raised whenever make_refine_mesh() gives any mesh another hierarchy, or a .pm file another
/// layout, or files beside it: what was kept before is then made anew.
inline constexpr unsigned refine_mesh_cache_version = 3;

/// The file of a folder in which the hierarchy of a mesh is kept, named by two hashes of all that
/// decides it: places, triangles, colours and materials.
std::filesystem::path
refine_mesh_cache_file(const std::filesystem::path& folder, const models::TriangleMesh& mesh);

/// make_refine_mesh(), read from the folder where the same mesh was made ready before, else made
/// and kept there. The hierarchy is the same, bit for bit, and so are the notes of what was
/// repaired in the mesh. A file that is damaged or cut off is made anew and replaced, with a note.
/// Processes may share a folder: files appear whole.
RefineMesh cached_refine_mesh(
    const std::filesystem::path& folder, const RefineMeshOptions& input, models::TriangleMesh mesh);

} // namespace octant::ui::world
