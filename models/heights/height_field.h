#pragma once

#include "sim/base/earth_frame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace octant::models::heights {

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

/// Bilinear height at a position, metres; nothing outside the field. `Grid` has columns(), rows(), spacing_m(),
/// half_extent_m() and height_m(column, row) as HeightField.
template <class Grid>
std::optional<double> bilinear_height_m(const Grid& grid, double x_m, double y_m) {
    const glm::dvec2 half = grid.half_extent_m();
    if (!(std::abs(x_m) <= half.x && std::abs(y_m) <= half.y)) { return std::nullopt; }
    const double across = (x_m + half.x) / grid.spacing_m();
    const double up = (y_m + half.y) / grid.spacing_m();
    const int column = std::min(static_cast<int>(across), grid.columns() - 2);
    const int row = std::min(static_cast<int>(up), grid.rows() - 2);
    const double u = across - column;
    const double v = up - row;
    const auto mixed = [&](int at_row) {
        return grid.height_m(column, at_row) * (1.0 - u) + grid.height_m(column + 1, at_row) * u;
    };
    return mixed(row) * (1.0 - v) + mixed(row + 1) * v;
}

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
