#pragma once

#include "visuals/groundfile/ground_header.h"

#include <cstddef>
#include <functional>
#include <span>

namespace octant::visuals::groundfile {

struct TileId {
    int level = 0;
    std::size_t tile = 0; ///< as the level's tiles lie in memory
};

/// Whether the tile of a level is sound in the file.
using TileCheck = std::function<bool(int level, std::size_t tile)>;

/// Writes what is known of a damaged tile into its memory. Heights of a level that has finer ones
/// are the means of the sound samples beside them; else each lies half-way between the ends of the
/// edge that it halves, as the coarser ground is drawn. Errors are the least of those of the
/// samples that they need: never below the true ones, so that errors stay nested and meshes have no
/// cracks. Reads other tiles through `ground`, but not this one.
void repair_tile(
    const TileCheck& is_intact,
    const GroundTiles& ground,
    TileId number,
    std::span<std::byte> bytes);

} // namespace octant::visuals::groundfile
