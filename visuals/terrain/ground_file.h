#pragma once

#include "visuals/terrain/ground_tiles.h"

#include <cstdint>
#include <filesystem>

namespace octant::visuals::terrain {

/// Whether a file begins as grounds do, sound or not. Never throws.
bool is_ground_file(const std::filesystem::path& path);

/// Maps a ground; its pages come from the disk when they are first read. Checks everything but the
/// tiles. Throws Error (no such file, another kind of file, unfinished, cut or damaged).
GroundTiles open_ground(const std::filesystem::path& path);

/// A hash of the header, what lies before the tiles and the checksums of all tiles, which tells one
/// ground from another without reading the tiles. Throws Error as open_ground.
std::uint64_t hash_of_ground(const std::filesystem::path& path);

/// Checks the tiles, too: reads all of the file. Throws Error that names the first bad tile.
void verify_ground(const std::filesystem::path& path, int threads = 2);

} // namespace octant::visuals::terrain
