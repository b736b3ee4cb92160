#include "models/heights/height_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::models::heights {

namespace {

/// Number of samples `spacing` apart that fit on `length`, forgiving a rounding error of its end.
int samples_on(double length, double spacing) {
    return static_cast<int>(std::floor(length / spacing + 1e-9)) + 1;
}

} // namespace

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

HeightGrid
squared(const HeightGrid& grid, double step_east_m, double step_north_m, double spacing_m) {
    HeightGrid result;
    result.columns = samples_on((grid.columns - 1) * step_east_m, spacing_m);
    result.rows = samples_on((grid.rows - 1) * step_north_m, spacing_m);
    result.heights_m.reserve(
        static_cast<std::size_t>(result.columns) * static_cast<std::size_t>(result.rows));
    const double first_column =
        0.5 * ((grid.columns - 1) - (result.columns - 1) * spacing_m / step_east_m);
    const double first_row = 0.5 * ((grid.rows - 1) - (result.rows - 1) * spacing_m / step_north_m);
    for (int row = 0; row < result.rows; ++row) {
        for (int column = 0; column < result.columns; ++column) {
            result.heights_m.push_back(interpolated(
                grid,
                first_column + column * spacing_m / step_east_m,
                first_row + row * spacing_m / step_north_m));
        }
    }
    return result;
}

} // namespace octant::models::heights
