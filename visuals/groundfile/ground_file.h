#pragma once

#include "visuals/terrain/ground_tiles.h"

#include <cstdint>
#include <filesystem>

namespace octant::visuals::groundfile {

using terrain::GroundTiles;

/// Whether a file begins as ground files do, whether it is sound or not. Never throws.
bool is_ground_file(const std::filesystem::path& path);

/// Maps a ground into memory; its pages come from the disk when they are first read. Checks everything but the tiles,
/// which are tested one by one when they are first read, and mended where they are damaged: damage_tally.h tells.
/// Throws Error (no such file, another kind of file, unfinished, cut off or damaged before the tiles).
GroundTiles open_ground(const std::filesystem::path& path);

/// A hash of the header, of what lies before the tiles and of the checksums of all tiles. It tells one ground from
/// another without reading the tiles. Throws Error as open_ground does.
std::uint64_t hash_of_ground(const std::filesystem::path& path);

/// Checks the tiles, too, which reads the whole file. Throws Error that names the first bad tile.
void verify_ground(const std::filesystem::path& path, int threads = 2);

} // namespace octant::visuals::groundfile
