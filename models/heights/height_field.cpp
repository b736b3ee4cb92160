#include "models/heights/height_field.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace octant::models::heights {

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
