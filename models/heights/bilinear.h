#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace octant::models::heights {

/// Height between the four samples around a place, metres; nothing outside the field. `Grid` has columns(), rows(),
/// spacing_m(), half_extent_m() and height_m(column, row) as HeightField.
template <class Grid>
std::optional<double> bilinear_height_m(const Grid& grid, double x_m, double y_m) {
    const glm::dvec2 half = grid.half_extent_m();
    if (!(std::abs(x_m) <= half.x && std::abs(y_m) <= half.y)) { return std::nullopt; }
    const double across = (x_m + half.x) / grid.spacing_m();
    const double up = (y_m + half.y) / grid.spacing_m();
    const int column = std::min(static_cast<int>(across), grid.columns() - 2);
    const int row = std::min(static_cast<int>(up), grid.rows() - 2);
    const double u = across - column;
    const double v = up - row;
    const auto mixed = [&](int at_row) {
        return grid.height_m(column, at_row) * (1.0 - u) + grid.height_m(column + 1, at_row) * u;
    };
    return mixed(row) * (1.0 - v) + mixed(row + 1) * v;
}

} // namespace octant::models::heights
