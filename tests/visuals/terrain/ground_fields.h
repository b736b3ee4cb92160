#pragma once

#include "models/heights/height_field.h"
#include "tests/rough_heights.h"
#include "visuals/terrain/bisection_ground_builder.h"

#include <algorithm>
#include <cmath>

namespace octant::visuals::terrain {

/// Rough ground of whole metres, 30 m apart, the same for the same seed.
inline models::heights::HeightField rough_metre_field(int columns, int rows, unsigned seed = 1, int range_m = 900) {
    return {columns, rows, 30.0, tests::rough_heights(columns, rows, seed, range_m)};
}

/// The height of the padded square: beyond its last column and row a field goes on as its reflection in the point on
/// its border, as far as 16 bits hold that, in whole metres.
inline double padded_height_m(const models::heights::HeightField& field, int column, int row) {
    const auto at_m = [&field](
                          int x, int y) { return static_cast<double>(field.height_m(std::max(x, 0), std::max(y, 0))); };
    const int x = std::min(column, field.columns() - 1);
    const int y = std::min(row, field.rows() - 1);
    if (x == column && y == row) { return at_m(x, y); }
    const auto reflected_m = [&](int of_row) { return 2.0 * at_m(x, of_row) - at_m(2 * x - column, of_row); };
    const GroundShape shape = shape_of(field.columns(), field.rows(), field.spacing_m(),
        static_cast<double>(field.lowest_m()), static_cast<double>(field.highest_m()));
    return std::clamp(2.0 * reflected_m(y) - reflected_m(2 * y - row),
        std::ceil(shape.height_base_m - 32768.0 * shape.height_unit_m),
        std::floor(shape.height_base_m + 32767.0 * shape.height_unit_m));
}

} // namespace octant::visuals::terrain
