// Source: membrane (Laplace) interpolation by a coarse-to-fine cascade: heights are averaged to half the resolution
// until no void is left ("pull"), voids then take the coarser level's height ("push", after Gortler et al., The
// Lumigraph, 1996, section 3.4) and are relaxed by Gauss-Seidel. Deviations: a fixed number of sweeps a level instead
// of a residual, so that cost and result are the same everywhere; the rim of the map takes part with the neighbours it
// has.
#include "models/heights/height_voids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octant::models::heights {

namespace {

constexpr int sweeps_a_level = 24;
constexpr float void_height = std::numeric_limits<float>::quiet_NaN();

std::vector<std::size_t> voids_of(const HeightGrid& grid) {
    std::vector<std::size_t> voids;
    for (std::size_t i = 0; i < grid.heights_m.size(); ++i) {
        if (std::isnan(grid.heights_m[i])) { voids.push_back(i); }
    }
    return voids;
}

/// Mean of the known samples of the 2 x 2 block from a sample on, NaN without any.
float block_mean(const HeightGrid& grid, int column, int row) {
    double sum = 0.0;
    int known = 0;
    for (int y = row; y < std::min(row + 2, grid.rows); ++y) {
        for (int x = column; x < std::min(column + 2, grid.columns); ++x) {
            const float height = grid.at(x, y);
            if (!std::isnan(height)) {
                sum += height;
                ++known;
            }
        }
    }
    return known == 0 ? void_height : static_cast<float>(sum / known);
}

HeightGrid halved(const HeightGrid& grid) {
    HeightGrid half;
    half.columns = (grid.columns + 1) / 2;
    half.rows = (grid.rows + 1) / 2;
    half.heights_m.reserve(static_cast<std::size_t>(half.columns) * static_cast<std::size_t>(half.rows));
    for (int row = 0; row < grid.rows; row += 2) {
        for (int column = 0; column < grid.columns; column += 2) {
            half.heights_m.push_back(block_mean(grid, column, row));
        }
    }
    return half;
}

float mean_of_neighbours(const HeightGrid& grid, int column, int row) {
    double sum = 0.0;
    int count = 0;
    constexpr std::array<std::array<int, 2>, 4> steps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    for (const auto& step : steps) {
        const int x = column + step[0];
        const int y = row + step[1];
        if (x >= 0 && x < grid.columns && y >= 0 && y < grid.rows) {
            sum += grid.at(x, y);
            ++count;
        }
    }
    return static_cast<float>(sum / count);
}

void relax(HeightGrid& grid, const std::vector<std::size_t>& voids) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (int sweep = 0; sweep < sweeps_a_level; ++sweep) {
        for (const std::size_t i : voids) {
            grid.heights_m[i] = mean_of_neighbours(grid, static_cast<int>(i % columns), static_cast<int>(i / columns));
        }
    }
}

float from_coarser(const HeightGrid& coarse, int column, int row) {
    if (coarse.columns < 2 || coarse.rows < 2) { return coarse.at(column / 2, row / 2); }
    return interpolated(coarse, (column - 0.5) / 2.0, (row - 0.5) / 2.0);
}

template <typename Guess>
void fill(HeightGrid& grid, const std::vector<std::size_t>& voids, const Guess& guess) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (const std::size_t i : voids) {
        grid.heights_m[i] = guess(static_cast<int>(i % columns), static_cast<int>(i / columns));
    }
    relax(grid, voids);
}

} // namespace

long fill_voids(HeightGrid& grid) {
    const std::vector<std::size_t> voids = voids_of(grid);
    if (voids.empty() || voids.size() == grid.heights_m.size()) { return static_cast<long>(voids.size()); }
    HeightGrid coarse = halved(grid);
    fill_voids(coarse);
    fill(grid, voids, [&coarse](int column, int row) { return from_coarser(coarse, column, row); });
    return static_cast<long>(voids.size());
}

long fill_voids_from(HeightGrid& grid, const std::function<float(int, int)>& guess) {
    const std::vector<std::size_t> voids = voids_of(grid);
    fill(grid, voids, guess);
    return static_cast<long>(voids.size());
}

} // namespace octant::models::heights
