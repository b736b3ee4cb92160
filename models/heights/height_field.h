#pragma once

#include "sim/base/geo_position.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace octant::models::heights {

/// A coordinate system whose x and y run along a field's own.
struct CoordinateSystem {
    std::string wkt;
    double centre_x = 0.0; ///< of the field, in the system's units
    double centre_y = 0.0;
    double unit_m = 1.0;
};

/// What a person should be told of a map: what was assumed or mended, or what looks wrong.
struct MapNote {
    /// One sentence that begins with the file's name and names the option that changes it.
    std::string text;
    /// Metres east and north of the field's centre; empty where the whole map is meant.
    std::vector<glm::dvec2> places_m = {};

    bool operator==(const MapNote&) const = default;
};

/// How far a ground lies from the surface it was made from, as measured at some places.
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
    std::optional<GeoPosition> place;       ///< of its centre; nothing for made ground
    std::optional<CoordinateSystem> system; ///< nothing for ground without a place in any
    long filled_voids = 0;                  ///< samples without data that were filled in on reading
    std::vector<MapNote> notes;             ///< of the files it was read from

private:
    int columns_;
    int rows_;
    double spacing_m_;
    std::vector<float> heights_m_;
    float lowest_m_;
    float highest_m_;
};

} // namespace octant::models::heights
