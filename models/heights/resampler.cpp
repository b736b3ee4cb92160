#include "models/heights/resampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::models::heights {

namespace {

constexpr int block_edge = 256;
/// Between places so many samples apart source coordinates run linearly: at 100 m spacing the error
/// is 0.05 m, far below a sample.
constexpr int place_step = 16;
/// How far beyond a grid's rim a place may lie by rounding, in cells.
constexpr double rim = 0.02;
constexpr float no_height = std::numeric_limits<float>::quiet_NaN();

double mixed(const std::vector<double>& at, std::size_t low, std::size_t high, double u, double v) {
    return (at[low] * (1.0 - u) + at[low + 1] * u) * (1.0 - v) +
           (at[high] * (1.0 - u) + at[high + 1] * u) * v;
}

} // namespace

void Resampler::read(int first_row, std::span<float> heights_m, const GdalSession& gdal) {
    const auto width = static_cast<std::size_t>(lattice_.columns);
    const int count = static_cast<int>(heights_m.size() / width);
    std::fill(heights_m.begin(), heights_m.end(), no_height);
    for (int row = 0; row < count; row += block_edge) {
        for (int column = 0; column < lattice_.columns; column += block_edge) {
            const Block block{
                column,
                std::min(block_edge, lattice_.columns - column),
                first_row + row,
                std::min(block_edge, count - row)};
            block_m_.assign(
                static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows),
                no_height);
            for (const SourceGrid& grid : grids_) {
                locate_samples(grid, block);
                const GridWindow window = window_of(grid);
                if (window.columns > 0 && window.rows > 0) {
                    source_m_.resize(
                        static_cast<std::size_t>(window.columns) *
                        static_cast<std::size_t>(window.rows));
                    grid.read(window, source_m_, gdal);
                    sample(block, window);
                }
            }
            for (int r = 0; r < block.rows; ++r) {
                std::copy_n(
                    block_m_.begin() + std::ptrdiff_t{r} * block.columns,
                    block.columns,
                    heights_m.begin() + static_cast<std::ptrdiff_t>(
                                            static_cast<std::size_t>(row + r) * width +
                                            static_cast<std::size_t>(column)));
            }
        }
    }
}

/// Where a block's samples lie in a grid: exact every place_step samples, linear between.
void Resampler::locate_samples(const SourceGrid& grid, const Block& block) {
    const int across = (block.columns - 1) / place_step + 2;
    const int up = (block.rows - 1) / place_step + 2;
    std::vector<double> x;
    std::vector<double> y;
    for (int j = 0; j < up; ++j) {
        for (int i = 0; i < across; ++i) {
            x.push_back(lattice_.west + (block.first_column + i * place_step) * lattice_.step);
            y.push_back(lattice_.south + (block.first_row + j * place_step) * lattice_.step);
        }
    }
    grid.grid_from_frame(x, y);
    half_step_ = 0.5 *
                 glm::dvec2(
                     std::hypot(x[1] - x[0], y[1] - y[0]),
                     std::hypot(
                         x[static_cast<std::size_t>(across)] - x[0],
                         y[static_cast<std::size_t>(across)] - y[0])) /
                 static_cast<double>(place_step);
    x_.clear();
    y_.clear();
    const double last_column = grid.columns() - 1.0;
    const double last_row = grid.rows() - 1.0;
    for (int r = 0; r < block.rows; ++r) {
        const double v = static_cast<double>(r % place_step) / place_step;
        for (int c = 0; c < block.columns; ++c) {
            const auto low = static_cast<std::size_t>(r / place_step * across + c / place_step);
            const std::size_t high = low + static_cast<std::size_t>(across);
            const double u = static_cast<double>(c % place_step) / place_step;
            const double column = mixed(x, low, high, u, v);
            const double row = mixed(y, low, high, u, v);
            const bool inside = column >= -rim && column <= last_column + rim && row >= -rim &&
                                row <= last_row + rim;
            x_.push_back(inside ? std::clamp(column, 0.0, last_column) : std::nan(""));
            y_.push_back(inside ? std::clamp(row, 0.0, last_row) : std::nan(""));
        }
    }
}

/// The part of a grid that the places of a block need; empty where all lie outside.
GridWindow Resampler::window_of(const SourceGrid& grid) const {
    double west = std::numeric_limits<double>::infinity();
    double east = -west;
    double south = west;
    double north = -west;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (!std::isnan(x_[i])) {
            west = std::min(west, x_[i]);
            east = std::max(east, x_[i]);
            south = std::min(south, y_[i]);
            north = std::max(north, y_[i]);
        }
    }
    if (west > east) {
        return {};
    }
    constexpr int beside = 2; // for the neighbours of summits
    const int first_column = std::max(0, static_cast<int>(west) - beside);
    const int first_row = std::max(0, static_cast<int>(south) - beside);
    return {
        first_column,
        std::min(grid.columns(), static_cast<int>(east) + beside + 2) - first_column,
        first_row,
        std::min(grid.rows(), static_cast<int>(north) + beside + 2) - first_row};
}

void Resampler::sample(const Block& block, const GridWindow& window) {
    for (std::size_t i = 0;
         i < static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows);
         ++i) {
        if (std::isnan(block_m_[i]) && !std::isnan(x_[i])) {
            const double column = x_[i] - window.first_column;
            const double row = y_[i] - window.first_row;
            const float surface = surface_m(window, column, row);
            const float summit = summit_m(window, column, row);
            block_m_[i] = summit > surface ? summit : surface;
        }
    }
}

/// The bilinear height; of the samples that are known where they have half of the weight or more,
/// else NaN.
float Resampler::surface_m(const GridWindow& window, double column, double row) const {
    const int c = std::min(static_cast<int>(column), std::max(window.columns - 2, 0));
    const int r = std::min(static_cast<int>(row), std::max(window.rows - 2, 0));
    const double u = column - c;
    const double v = row - r;
    double sum = 0.0;
    double known = 0.0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const double weight = (i == 0 ? 1.0 - u : u) * (j == 0 ? 1.0 - v : v);
            if (weight > 1e-6) {
                const auto height_m =
                    static_cast<double>(source_m_
                                            [static_cast<std::size_t>(r + j) *
                                                 static_cast<std::size_t>(window.columns) +
                                             static_cast<std::size_t>(c + i)]);
                sum += std::isnan(height_m) ? 0.0 : weight * height_m;
                known += std::isnan(height_m) ? 0.0 : weight;
            }
        }
    }
    return known >= 0.5 ? static_cast<float>(sum / known) : no_height;
}

/// The height of the source sample to which this place is the nearest of the lattice, if that one
/// is higher than all around it; else the lowest number.
float Resampler::summit_m(const GridWindow& window, double column, double row) const {
    constexpr float none = std::numeric_limits<float>::lowest();
    const int c = static_cast<int>(std::lround(column));
    const int r = static_cast<int>(std::lround(row));
    if (c < 1 || r < 1 || c + 1 >= window.columns || r + 1 >= window.rows ||
        std::abs(column - c) > half_step_.x || std::abs(row - r) > half_step_.y) {
        return none;
    }
    const auto at = [&](int x, int y) {
        return source_m_
            [static_cast<std::size_t>(y) * static_cast<std::size_t>(window.columns) +
             static_cast<std::size_t>(x)];
    };
    const float own = at(c, r);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            if ((i != 0 || j != 0) && !(at(c + i, r + j) < own)) {
                return none;
            }
        }
    }
    return own;
}

} // namespace octant::models::heights
