#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <cstddef>
#include <filesystem>
#include <limits>

namespace octant::visuals::refine {

/// Whether a file calls itself a progressive mesh by its ending, .pm.
bool is_progressive_file(const std::filesystem::path& path);

/// Writes a versioned file of checksummed blocks: base mesh, splits from the coarsest on, numbers
/// of the original. Throws Error.
void write_progressive(const std::filesystem::path& path, const ProgressiveMesh& mesh);

/// Reads a file of write_progressive. With fewer than all vertices, or where the file was cut off
/// (a note says so), the splits read so far make a coarser model: a hierarchy of its own, whose
/// original mesh is the one after those splits. No more than these splits are read. A whole file
/// gives back the mesh that was written: the same nodes, vertices and faces in the original's
/// order. Throws Error for anything else that write_progressive does not write, and for a file cut
/// off within its base mesh. Makes room for no more than the file holds.
ProgressiveMesh read_progressive(
    const std::filesystem::path& path,
    std::size_t most_vertices = std::numeric_limits<std::size_t>::max());

} // namespace octant::visuals::refine
