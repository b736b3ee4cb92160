#pragma once

#include <cstddef>
#include <vector>

namespace octant::models::heights {

/// Heights on their way into a HeightField: row after row from the south, west to east. NaN marks a sample without data
/// until fill_voids has run.
struct HeightGrid {
    int columns = 0;
    int rows = 0;
    std::vector<float> heights_m;

    float at(int column, int row) const { return heights_m[index(column, row)]; }

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    }
};

/// Bilinear height at fractional grid coordinates; beyond the grid the height of its rim. At least 2 x 2 samples
/// (asserted).
float interpolated(const HeightGrid& grid, double column, double row);

} // namespace octant::models::heights
