#pragma once

#include "models/procedural/terrain_grid.h"

#include <cstdint>
#include <span>

namespace octant::models::procedural {

/// Where a row's cells drain to; as many entries as it has cells.
struct RowReceivers {
    std::span<int> receiver;    ///< cell of the grid
    std::span<double> length_m; ///< way to it
};

/// Finds the lower neighbour that each cell of a row drains to, as compute_drainage() says; itself, a cell's width
/// away, where none is lower.
void choose_receivers(const TerrainGrid& ground, int row, std::uint64_t seed, const RowReceivers& to);

} // namespace octant::models::procedural
