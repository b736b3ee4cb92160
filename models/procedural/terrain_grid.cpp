#include "models/procedural/terrain_grid.h"

#include "sim/base/thread_pool.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace octant::models::procedural {

namespace {

std::array<double, 4> catmull_rom(double t) {
    return {0.5 * t * (-1.0 + t * (2.0 - t)), 0.5 * (2.0 + t * t * (-5.0 + 3.0 * t)),
        0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)};
}

} // namespace

double TerrainGrid::smooth_at(double x_m, double y_m) const {
    const double x = std::clamp(x_m / cell_m, 0.0, side - 1.0);
    const double y = std::clamp(y_m / cell_m, 0.0, side - 1.0);
    const int column = std::min(static_cast<int>(x), side - 2);
    const int row = std::min(static_cast<int>(y), side - 2);
    const auto across = catmull_rom(x - column);
    const auto up = catmull_rom(y - row);
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) {
        const int r = std::clamp(row + j - 1, 0, side - 1);
        double line = 0.0;
        for (int i = 0; i < 4; ++i) {
            const int c = std::clamp(column + i - 1, 0, side - 1);
            line += across[static_cast<std::size_t>(i)] * at(c, r);
        }
        sum += up[static_cast<std::size_t>(j)] * line;
    }
    return sum;
}

RowPoints points_of_row(const TerrainGrid& grid, int row) {
    RowPoints places(static_cast<std::size_t>(grid.side));
    for (int column = 0; column < grid.side; ++column) {
        const auto i = static_cast<std::size_t>(column);
        places.x_m[i] = column * grid.cell_m;
        places.y_m[i] = row * grid.cell_m;
    }
    return places;
}

TerrainGrid refined(const TerrainGrid& grid, const DomainWarp& warp) {
    TerrainGrid fine(2 * grid.side - 1, grid.cell_m / 2.0);
    parallel_for_rows(fine.side, [&](int row) {
        RowPoints places = points_of_row(fine, row);
        warp.move(places.x_m, places.y_m, 1.0);
        for (int column = 0; column < fine.side; ++column) {
            const auto i = static_cast<std::size_t>(column);
            fine.values[fine.index(column, row)] = grid.smooth_at(places.x_m[i], places.y_m[i]);
        }
    });
    return fine;
}

void diffuse(TerrainGrid& grid, double share) {
    assert(grid.side >= 3);
    const std::vector<double> old = grid.values;
    const auto step = static_cast<std::size_t>(grid.side);
    parallel_for_rows(grid.side - 2, [&](int from_second) {
        for (int column = 1; column + 1 < grid.side; ++column) {
            const std::size_t i = grid.index(column, from_second + 1);
            const double around = old[i - 1] + old[i + 1] + old[i - step] + old[i + step];
            grid.values[i] = old[i] + share * (around - 4.0 * old[i]);
        }
    });
}

} // namespace octant::models::procedural
