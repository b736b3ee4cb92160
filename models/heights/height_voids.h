#pragma once

#include "models/heights/height_grid.h"

#include <functional>

namespace octant::models::heights {

/// Gives every NaN sample a height that runs smoothly from rim to rim of its void (a membrane), and returns how many
/// there were. Known samples stay as they are. A grid without any known sample is left untouched. Memory while it runs:
/// a third of the grid and 8 bytes a void; nothing without voids.
long fill_voids(HeightGrid& grid);

/// The same for a piece of a larger grid: what is not in the piece comes from a guess at a void's height by its column
/// and row, such as a coarser grid's.
long fill_voids_from(HeightGrid& grid, const std::function<float(int, int)>& guess);

} // namespace octant::models::heights
