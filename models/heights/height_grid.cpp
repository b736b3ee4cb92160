#include "models/heights/height_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::models::heights {

float interpolated(const HeightGrid& grid, double column, double row) {
    assert(grid.columns >= 2 && grid.rows >= 2);
    const double across = std::clamp(column, 0.0, grid.columns - 1.0);
    const double up = std::clamp(row, 0.0, grid.rows - 1.0);
    const int west = std::min(static_cast<int>(across), grid.columns - 2);
    const int south = std::min(static_cast<int>(up), grid.rows - 2);
    const double u = across - west;
    const double v = up - south;
    const double low = grid.at(west, south) * (1.0 - u) + grid.at(west + 1, south) * u;
    const double high = grid.at(west, south + 1) * (1.0 - u) + grid.at(west + 1, south + 1) * u;
    return static_cast<float>(low * (1.0 - v) + high * v);
}

} // namespace octant::models::heights
