#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <cstddef>
#include <filesystem>
#include <limits>

namespace octant::visuals::refine {

/// Whether a file calls itself a progressive mesh by its ending, .pm.
bool is_progressive_file(const std::filesystem::path& path);

/// Writes a versioned file of checksummed blocks: the base mesh, the vertex splits from the coarsest on, and the
/// original's vertex and face numbers. Throws Error when the file cannot be written.
void write_progressive(const std::filesystem::path& path, const ProgressiveMesh& mesh);

/// Reads a file that write_progressive wrote. A whole file gives back the same hierarchy: the same nodes, and vertices
/// and faces in the original's order.
///
/// When fewer than all vertices are asked for, or the file was cut off (a note says so), the splits that were read make
/// a coarser model: a hierarchy of its own whose original mesh is the one after those splits. No more than these splits
/// are read. Throws Error for anything that write_progressive would not write, and for a file cut off within its base
/// mesh. The memory used is bounded by what the file holds, whatever counts it claims.
ProgressiveMesh read_progressive(
    const std::filesystem::path& path, std::size_t max_vertices = std::numeric_limits<std::size_t>::max());

} // namespace octant::visuals::refine
