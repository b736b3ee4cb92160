#pragma once

#include "models/height_grid.h"

namespace octant::models {

/// Gives every NaN sample a height that runs smoothly from rim to rim of its void (a membrane), and
/// returns how many there were. Known samples stay as they are. A grid without any known sample is
/// left untouched. Memory while it runs: a third of the grid and 8 bytes a void; nothing without
/// voids.
long fill_voids(HeightGrid& grid);

} // namespace octant::models
