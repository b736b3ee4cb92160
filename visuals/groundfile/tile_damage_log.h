#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace octant::visuals::groundfile {

/// A tile by its level and its place among the level's tiles.
struct DamagedTile {
    int level = 0;
    std::size_t column = 0;
    std::size_t row = 0;
};

/// Counts a damaged tile that this program met. Any thread may call it.
void log_tile_damage(const std::filesystem::path& file, const DamagedTile& tile);

/// One line for each ground file in which this program met damage so far: how many tiles, and the first of them by
/// level and place. Empty when there was none.
std::vector<std::string> tile_damage_messages();

} // namespace octant::visuals::groundfile
