#pragma once

#include "models/meshfile/mesh_file.h"
#include "models/triangle_mesh.h"

#include <filesystem>
#include <string>

namespace octant::ui::world {

/// Whether a file's ending is one that a library's reader takes: Assimp's or OpenSceneGraph's.
bool is_library_file(const std::filesystem::path& file);

/// Reads a mesh by a library in a process of its own, with limits of time (25 s) and memory (4 GiB). Of the options
/// `pictures` and `backs` count. Throws Error "file: ..." in one line, also where the library crashes and where the
/// program was built without it.
models::TriangleMesh read_library_mesh(
    const std::filesystem::path& file, const models::meshfile::ReadOptions& options = {});

/// The endings that this build reads by libraries, a line each; said by octant --version.
std::string library_formats();

} // namespace octant::ui::world
