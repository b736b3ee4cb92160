#include "visuals/roads/road_cost_grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::roads {

namespace {

constexpr double default_cell_m = 100.0;
constexpr double max_cell_m = 600.0;
constexpr int max_cells = 512; ///< a side
constexpr int min_cells = 12; ///< a side
constexpr double valley_radius_m = 1500.0;
constexpr int min_water_samples = 8; ///< for water, along each side of a cell, if there are samples
constexpr double water_clearance_m = 0.5;
constexpr double max_relief = 0.8; ///< of a cell that is no cliff, over its width
// What doubles the cost of a road.
constexpr double doubling_climb = 0.08;
constexpr double doubling_slope = 0.18;
constexpr double doubling_above_valley_m = 120.0;

/// How many samples lie from one cell to the next.
int stride_of(const terrain::GroundSamples& ground) {
    const int longest = std::max(ground.columns(), ground.rows()) - 1;
    const int by_width = static_cast<int>(std::ceil(default_cell_m / ground.spacing_m()));
    return std::max({by_width, (longest + max_cells - 1) / max_cells, 1});
}

/// The least of each value and those up to `reach` places before and after it.
void spread_minimum(const std::vector<double>& from, int reach, std::vector<double>& to) {
    const auto count = static_cast<int>(from.size());
    to.resize(from.size());
    for (int i = 0; i < count; ++i) {
        const auto first = from.begin() + std::max(i - reach, 0);
        const auto end = from.begin() + std::min(i + reach + 1, count);
        to[static_cast<std::size_t>(i)] = *std::min_element(first, end);
    }
}

} // namespace

RoadCostGrid::RoadCostGrid(const terrain::GroundSamples& ground, const RoadConstraints& constraints) {
    const int stride = stride_of(ground);
    const glm::ivec2 cells = (glm::ivec2(ground.columns(), ground.rows()) - 1) / stride;
    cell_m_ = stride * ground.spacing_m();
    if (cell_m_ > max_cell_m || std::min(cells.x, cells.y) < min_cells) {
        return;
    }
    columns_ = cells.x;
    rows_ = cells.y;
    first_m_ = glm::dvec2(ground.sample_m(0, 0)) + 0.5 * cell_m_;
    read(ground, stride, constraints);
    find_slopes();
    find_valley_floors();
}

void RoadCostGrid::read(const terrain::GroundSamples& ground, int stride, const RoadConstraints& constraints) {
    const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    heights_m_.reserve(count);
    free_.reserve(count);
    const int step = std::max(stride / min_water_samples, 1);
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            double lowest_m = ground.height_m(column * stride, row * stride);
            double highest_m = lowest_m;
            double sum_m = 0.0;
            int seen = 0;
            for (int north = 0; north <= stride; north += step) {
                for (int east = 0; east <= stride; east += step) {
                    const double height_m =
                        ground.height_m(column * stride + east, row * stride + north);
                    lowest_m = std::min(lowest_m, height_m);
                    highest_m = std::max(highest_m, height_m);
                    sum_m += height_m;
                    ++seen;
                }
            }
            heights_m_.push_back(sum_m / seen);
            const bool is_dry = lowest_m > constraints.water_m + water_clearance_m;
            const bool is_blocked = constraints.is_blocked && constraints.is_blocked(place_m(free_.size()));
            const bool is_cliff = highest_m - lowest_m > max_relief * cell_m_;
            free_.push_back(is_dry && !is_cliff && !is_blocked ? 1 : 0);
        }
    }
}

void RoadCostGrid::find_slopes() {
    slopes_.reserve(heights_m_.size());
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const int west = std::max(column - 1, 0);
            const int east = std::min(column + 1, columns_ - 1);
            const int south = std::max(row - 1, 0);
            const int north = std::min(row + 1, rows_ - 1);
            const glm::dvec2 rise(
                (heights_m_[cell(east, row)] - heights_m_[cell(west, row)]) / (east - west),
                (heights_m_[cell(column, north)] - heights_m_[cell(column, south)]) /
                    (north - south));
            slopes_.push_back(glm::length(rise) / cell_m_);
        }
    }
}

/// Along rows, then along columns.
void RoadCostGrid::find_valley_floors() {
    const int reach = std::max(static_cast<int>(valley_radius_m / cell_m_), 1);
    valley_floors_m_ = heights_m_;
    std::vector<double> line;
    std::vector<double> least;
    const auto spread = [&](int lines, int length, const auto& cell_of) {
        for (int i = 0; i < lines; ++i) {
            line.clear();
            for (int j = 0; j < length; ++j) {
                line.push_back(valley_floors_m_[cell_of(i, j)]);
            }
            spread_minimum(line, reach, least);
            for (int j = 0; j < length; ++j) {
                valley_floors_m_[cell_of(i, j)] = least[static_cast<std::size_t>(j)];
            }
        }
    };
    spread(rows_, columns_, [this](int row, int column) { return cell(column, row); });
    spread(columns_, rows_, [this](int column, int row) { return cell(column, row); });
}

double RoadCostGrid::cost_m(std::size_t from, std::size_t to) const {
    const auto squared = [](double share) { return share * share; };
    const double length_m = glm::distance(place_m(from), place_m(to));
    const double climb = (heights_m_[to] - heights_m_[from]) / length_m;
    const double slope = 0.5 * (slopes_[from] + slopes_[to]);
    const double above_m = 0.5 * (height_above_valley_m(from) + height_above_valley_m(to));
    return length_m * (1.0 + squared(climb / doubling_climb) + squared(slope / doubling_slope) +
                       above_m / doubling_above_valley_m);
}

} // namespace octant::visuals::roads
