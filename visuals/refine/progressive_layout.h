#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace octant::visuals::refine {

// A progressive file is a mark and blocks, each of a byte count (32 bits), so many bytes and their hash (64 bits):
//   head     version, length of the file, counts, flags, origin, name, materials
//   base     roots with the number of leaves below each, faces of the base mesh
//   splits   splits_per_block each, coarsest first
//   numbers  of the original: one a leaf, one a face
// Leaves are named by their place in the hierarchy's order, which holds for any coarser model too: a node that is not
// split there stands for all leaves below it.

inline constexpr std::string_view progressive_signature = "OCTPM\r\n\x1a";
inline constexpr std::uint32_t progressive_version = 1;
inline constexpr std::size_t splits_per_block = 512;
inline constexpr std::size_t block_header_bytes = 12; ///< The bytes of a block's count and hash.

// Flags of the head.
inline constexpr std::uint8_t has_colours = 1;
inline constexpr std::uint8_t has_materials = 2;

// Flags of a split: whether it adds a face to the left and to the right of the new edge.
inline constexpr std::uint8_t has_left_face = 1;
inline constexpr std::uint8_t has_right_face = 2;

} // namespace octant::visuals::refine
