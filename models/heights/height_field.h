#pragma once

#include "sim/base/earth_frame.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace octant::models::heights {

/// The bilinear mean of the values at the south-west, south-east, north-west and north-east corner of a cell, at a
/// position in shares of its sides from the south-west corner.
template <class Value, class Share>
Value bilinear(const Value& sw, const Value& se, const Value& nw, const Value& ne, const glm::vec<2, Share>& share) {
    return glm::mix(glm::mix(sw, se, share.x), glm::mix(nw, ne, share.x), share.y);
}

/// bilinear() of heights without those that are missing (NaN), whose weight the others share. Nothing if the known
/// heights have less than `min_weight` of it. Corners of a weight up to 1e-6 never count.
std::optional<double> bilinear_of_known(
    const std::array<float, 4>& heights_m, const glm::dvec2& share, double min_weight);

/// A cell of a grid by its south-west sample, and a position in it.
struct CellPosition {
    int column = 0;
    int row = 0;
    glm::dvec2 share{0.0}; ///< of the cell's sides, from the south-west
};

/// The cell with a position in columns and rows, which lies within the grid. The cells at the east and north border
/// contain it; in a grid with one column or row the cell has no other side.
inline CellPosition cell_at(const glm::dvec2& column_row, int columns, int rows) {
    const int column = std::clamp(static_cast<int>(column_row.x), 0, std::max(columns - 2, 0));
    const int row = std::clamp(static_cast<int>(column_row.y), 0, std::max(rows - 2, 0));
    return {column, row, column_row - glm::dvec2(column, row)};
}

/// Bilinear height at a position in columns and rows. `Grid` has columns(), rows() and height_m(column, row) as
/// HeightField, and at least 2 x 2 samples.
template <class Grid>
double bilinear_height_at_sample(const Grid& grid, const glm::dvec2& column_row) {
    const CellPosition cell = cell_at(column_row, grid.columns(), grid.rows());
    const auto height = [&](int column, int row) { return static_cast<double>(grid.height_m(column, row)); };
    return bilinear(height(cell.column, cell.row), height(cell.column + 1, cell.row), height(cell.column, cell.row + 1),
        height(cell.column + 1, cell.row + 1), cell.share);
}

/// Bilinear height at a position, metres; nothing outside the field. `Grid` also has spacing_m() and half_extent_m().
template <class Grid>
std::optional<double> bilinear_height_m(const Grid& grid, double x_m, double y_m) {
    const glm::dvec2 half = grid.half_extent_m();
    if (!(std::abs(x_m) <= half.x && std::abs(y_m) <= half.y)) { return std::nullopt; }
    return bilinear_height_at_sample(grid, (glm::dvec2(x_m, y_m) + half) / static_cast<double>(grid.spacing_m()));
}

/// Heights before they become a HeightField: row after row from the south, west to east. NaN marks a sample without
/// data until fill_voids has run.
struct HeightGrid {
    int columns = 0;
    int rows = 0;
    std::vector<float> heights_m;

    float at(int column, int row) const { return heights_m[index(column, row)]; }

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    }
};

/// Bilinear height at fractional grid coordinates; outside the grid the height at its border. The grid needs at least 2
/// x 2 samples (asserted).
float interpolated(const HeightGrid& grid, double column, double row);

/// A coordinate system with the same axis directions as the field.
struct CoordinateSystem {
    std::string wkt;
    double centre_x = 0.0; ///< x of the field's centre, in the system's units
    double centre_y = 0.0;
    double unit_m = 1.0;
};

/// A message about a map: an assumption, a repair or a suspicious value.
struct MapNote {
    /// One sentence that begins with the file's name and names the option that changes it.
    std::string text;
    /// Positions of the values in question, metres east and north of the field's centre; empty for the whole map.
    std::vector<glm::dvec2> places_m = {};

    bool operator==(const MapNote&) const = default;
};

/// The vertical distance between a ground and its source, measured at some positions.
struct HeightDeviation {
    double rms_m = 0.0;
    double worst_m = 0.0;
    std::int64_t places = 0;
};

/// Ground heights on a square grid. World: x east, y north, z up, metres, origin at the field's centre at datum. Column
/// 0 is the west edge, row 0 the south edge.
class HeightField {
public:
    /// `heights_m` row after row from the south, columns * rows finite values (asserted); at least 2 x 2 samples;
    /// spacing above zero.
    HeightField(int columns, int rows, double spacing_m, std::vector<float> heights_m);

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    double spacing_m() const { return spacing_m_; }

    /// Height of a sample. Column and row are within the grid (asserted).
    float height_m(int column, int row) const {
        return heights_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column)];
    }

    /// World position of a sample.
    glm::dvec3 sample_m(int column, int row) const;

    /// Half the extent of the field from its centre, east and north, metres.
    glm::dvec2 half_extent_m() const;

    /// Height of the ground between samples (bilinear); nothing outside the field.
    std::optional<double> height_at(double x_m, double y_m) const;

    /// Unit normal of the full-resolution ground at a sample, from central differences.
    glm::vec3 normal_at_sample(int column, int row) const;

    float lowest_m() const { return lowest_m_; }

    float highest_m() const { return highest_m_; }

    std::string name;                       ///< built-in name or file name, for reports
    std::optional<GeoPosition> place;       ///< position of the centre; nothing for generated ground
    std::optional<CoordinateSystem> system; ///< nothing for ground without a coordinate system
    long filled_voids = 0;                  ///< number of samples without data that were filled
    std::vector<MapNote> notes;             ///< messages about its files

private:
    int columns_;
    int rows_;
    double spacing_m_;
    std::vector<float> heights_m_;
    float lowest_m_;
    float highest_m_;
};

} // namespace octant::models::heights
