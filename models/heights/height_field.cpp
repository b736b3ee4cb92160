#include "models/heights/height_field.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace octant::models::heights {

std::optional<double> bilinear_of_known(
    const std::array<float, 4>& heights_m, const glm::dvec2& share, double min_weight) {
    constexpr double negligible = 1e-6;
    double sum_m = 0.0;
    double known = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double weight = (i % 2 == 0 ? 1.0 - share.x : share.x) * (i < 2 ? 1.0 - share.y : share.y);
        if (weight > negligible && !std::isnan(heights_m[i])) {
            sum_m += weight * static_cast<double>(heights_m[i]);
            known += weight;
        }
    }
    return known >= min_weight ? std::optional(sum_m / known) : std::nullopt;
}

float interpolated(const HeightGrid& grid, double column, double row) {
    assert(grid.columns >= 2 && grid.rows >= 2);
    const glm::dvec2 last(grid.columns - 1, grid.rows - 1);
    const CellPosition cell =
        cell_at(glm::clamp(glm::dvec2(column, row), glm::dvec2(0.0), last), grid.columns, grid.rows);
    const auto height = [&](int x, int y) { return static_cast<double>(grid.at(cell.column + x, cell.row + y)); };
    return static_cast<float>(bilinear(height(0, 0), height(1, 0), height(0, 1), height(1, 1), cell.share));
}

HeightField::HeightField(int columns, int rows, double spacing_m, std::vector<float> heights_m)
    : columns_(columns), rows_(rows), spacing_m_(spacing_m), heights_m_(std::move(heights_m)) {
    assert(columns >= 2 && rows >= 2);
    assert(spacing_m > 0.0 && std::isfinite(spacing_m));
    assert(heights_m_.size() == static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    assert(std::all_of(heights_m_.begin(), heights_m_.end(), [](float height) { return std::isfinite(height); }));
    const auto [lowest, highest] = std::minmax_element(heights_m_.begin(), heights_m_.end());
    lowest_m_ = *lowest;
    highest_m_ = *highest;
}

glm::dvec3 HeightField::sample_m(int column, int row) const {
    const glm::dvec2 half = half_extent_m();
    return {column * spacing_m_ - half.x, row * spacing_m_ - half.y, static_cast<double>(height_m(column, row))};
}

glm::dvec2 HeightField::half_extent_m() const {
    return {0.5 * (columns_ - 1) * spacing_m_, 0.5 * (rows_ - 1) * spacing_m_};
}

std::optional<double> HeightField::height_at(double x_m, double y_m) const {
    return bilinear_height_m(*this, x_m, y_m);
}

glm::vec3 HeightField::normal_at_sample(int column, int row) const {
    const int west = std::max(column - 1, 0);
    const int east = std::min(column + 1, columns_ - 1);
    const int south = std::max(row - 1, 0);
    const int north = std::min(row + 1, rows_ - 1);
    const double rise_east = static_cast<double>(height_m(east, row)) - height_m(west, row);
    const double rise_north = static_cast<double>(height_m(column, north)) - height_m(column, south);
    const glm::dvec3 normal(
        -rise_east / ((east - west) * spacing_m_), -rise_north / ((north - south) * spacing_m_), 1.0);
    return glm::vec3(glm::normalize(normal));
}

} // namespace octant::models::heights
