#pragma once

#include "models/procedural/terrain_noise.h"

#include <cstddef>
#include <span>
#include <vector>

namespace octant::models::procedural {

/// Ground is generated on a grid that is rotated by the angle of the triangle (3, 4, 5) and larger than the field,
/// which hides its lattice and its border.
inline constexpr double rotation_cos = 0.8;
inline constexpr double rotation_sin = 0.6;
inline constexpr double upscale_factor = 1.42;

/// Heights during generation: a square of side * side values, row after row from the south.
struct TerrainGrid {
    int side = 0;
    double cell_m = 0.0; ///< between samples
    std::vector<double> values;

    TerrainGrid() = default;

    TerrainGrid(int samples, double cell)
        : side(samples), cell_m(cell), values(static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples)) {}

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) + static_cast<std::size_t>(column);
    }

    double at(int column, int row) const { return values[index(column, row)]; }

    std::span<double> row(int number) { return {&values[index(0, number)], static_cast<std::size_t>(side)}; }

    /// The Catmull-Rom interpolation at a position in metres from sample (0, 0); outside the grid the value at its
    /// border.
    double smooth_at(double x_m, double y_m) const;
};

/// The x and y of consecutive positions, metres.
struct RowPoints {
    std::vector<double> x_m;
    std::vector<double> y_m; ///< of the same length

    explicit RowPoints(std::size_t count) : x_m(count), y_m(count) {}
};

/// The positions of a row's samples, relative to sample (0, 0).
RowPoints points_of_row(const TerrainGrid& grid, int row);

/// The ground with half the cell size, interpolated smoothly and displaced by the warp.
TerrainGrid refined(const TerrainGrid& grid, const DomainWarp& warp);

/// One pass of diffusion: each inner value moves by `share` (0 to 0.25) of the sum of differences to its four
/// neighbours. The grid has at least 3 samples a side.
void diffuse(TerrainGrid& grid, double share);

} // namespace octant::models::procedural
