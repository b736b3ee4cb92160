#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace octant::visuals::refine {

// A progressive file is a mark and blocks, each of a byte count (32 bits), so many bytes and their hash (64 bits):
//   head     version, length of the file, counts, flags, origin, name, materials (from version 2 on with opacity)
//   base     roots with the number of leaves below each, faces of the base mesh
//   splits   splits_per_block each, coarsest first
//   numbers  of the original: one a leaf, one a face
// Leaves are named by their place in the hierarchy's order, which holds for any coarser model too: a node that is not
// split there stands for all leaves below it.

inline constexpr std::string_view progressive_signature = "OCTPM\r\n\x1a";
inline constexpr std::uint32_t progressive_version = 2;
inline constexpr std::size_t splits_per_block = 512;
inline constexpr std::size_t block_header_bytes = 12; ///< The bytes of a block's count and hash.

// Flags of the head.
inline constexpr std::uint8_t has_colours = 1;
inline constexpr std::uint8_t has_materials = 2;

// Flags of a split: whether it adds a face to the left and to the right of the new edge.
inline constexpr std::uint8_t has_left_face = 1;
inline constexpr std::uint8_t has_right_face = 2;

/// Whether a file calls itself a progressive mesh by its ending, .pm.
bool is_progressive_file(const std::filesystem::path& path);

/// A versioned file of checksummed blocks: the base mesh, the vertex splits from the coarsest on, and the original's
/// vertex and face numbers.
std::string progressive_bytes(const ProgressiveMesh& mesh);

/// Writes progressive_bytes. Throws Error when the file cannot be written.
void write_progressive(const std::filesystem::path& path, const ProgressiveMesh& mesh);

/// Reads a file that write_progressive wrote, or wrote in version 1. A whole file gives back the same hierarchy: the
/// same nodes, and vertices and faces in the original's order.
///
/// When fewer than all vertices are asked for, or the file was cut off (a note says so), the splits that were read make
/// a coarser model: a hierarchy of its own whose original mesh is the one after those splits. No more than these splits
/// are read. Throws Error for anything that write_progressive would not write, and for a file cut off within its base
/// mesh. The memory used is bounded by what the file holds, whatever counts it claims.
ProgressiveMesh read_progressive(
    const std::filesystem::path& path, std::size_t max_vertices = std::numeric_limits<std::size_t>::max());

/// As read_progressive, from the bytes of a file. `path` is for messages.
ProgressiveMesh progressive_mesh(std::string_view bytes, const std::filesystem::path& path,
    std::size_t max_vertices = std::numeric_limits<std::size_t>::max());

} // namespace octant::visuals::refine
