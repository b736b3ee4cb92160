#pragma once

#include "models/heights/height_field.h"
#include "sim/base/earth_frame.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace octant::models::heights {

/// The axis-parallel bounding rectangle of points. Without points it has no area.
struct MapRectangle {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec2& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }

    glm::dvec2 size() const { return max - min; }

    double area() const {
        const glm::dvec2 sides = glm::max(size(), glm::dvec2(0.0));
        return sides.x * sides.y;
    }
};

struct TransformationDeleter {
    void operator()(void* transformation) const;
};

/// Owner of an OGRCoordinateTransformationH.
using Transformation = std::unique_ptr<void, TransformationDeleter>;

/// An OGRSpatialReferenceH, owned elsewhere.
using SpatialReferenceHandle = void*;

/// A counted OGRSpatialReferenceH of our own.
using SpatialReference = std::shared_ptr<void>;

/// Converts the column and row of a grid's sample to its coordinate system, in the system's units: x = x0 + x_column *
/// column + x_row * row; the same for y.
struct GridTransform {
    double x0 = 0.0;
    double x_column = 1.0;
    double x_row = 0.0;
    double y0 = 0.0;
    double y_column = 0.0;
    double y_row = 1.0;

    glm::dvec2 at(double column, double row) const {
        return {x0 + x_column * column + x_row * row, y0 + y_column * column + y_row * row};
    }

    /// Whether columns run east or west and rows north or south.
    bool is_upright() const { return x_row == 0.0 && y_column == 0.0; }

    /// The lengths of a column's and a row's step.
    glm::dvec2 steps() const;

    /// Converts from the coordinate system to column and row. The grid must have an area.
    GridTransform inverse() const;
};

/// A system as well-known text; empty if GDAL cannot write it.
std::string wkt_of(SpatialReferenceHandle system);

/// The ellipsoid of a system given as well-known text; WGS 84 for each system of the earth and for a system that names
/// no ellipsoid.
Ellipsoid ellipsoid_of(const std::string& wkt);

/// The geographic system of an ellipsoid: longitude, then latitude, in degrees.
SpatialReference geographic_coordinate_system(const Ellipsoid& ellipsoid);

/// The value of ImportOptions::system for files in metres that are not georeferenced.
inline constexpr std::string_view local_metres_name = "metres";

/// The system that a value of ImportOptions::system names. Throws Error for an unknown name.
SpatialReference coordinate_system_from_name(const std::string& name);

/// A copy of a system with shared ownership.
SpatialReference spatial_reference_of(SpatialReferenceHandle system);

/// The transverse Mercator projection of scale 1 with its origin at `place`: x is east, y is north, metres. Null if
/// there is none.
SpatialReference local_coordinate_system(const GeoPosition& place);

/// The transformation between two systems; null if there is none.
Transformation between(SpatialReferenceHandle from, SpatialReferenceHandle to);

/// Transforms points in place. Points that cannot be transformed become NaN. A null transformation changes nothing.
void transform_points(const Transformation& by, std::span<double> x, std::span<double> y);

/// A transformed point; nothing if it cannot be transformed.
std::optional<glm::dvec2> moved(const Transformation& by, glm::dvec2 point);

/// How much a projection distorts lengths and directions.
struct ProjectionDistortion {
    double scale_percent = 0.0; ///< the largest relative error of a length
    double turn_deg = 0.0;      ///< the largest angle between grid north and true north
};

/// The distortion at the four corners of a field. Nothing if the system is not georeferenced.
std::optional<ProjectionDistortion> distortion_at_corners(
    const CoordinateSystem& system, const glm::dvec2& half_extent_m);

/// The frame of ground whose axes are those of a map's coordinate system. Farther than 1,000 km from the ground, and
/// where the system is not defined, positions follow the transverse Mercator projection at the ground's centre, which
/// is also the frame of ground with a position only. Null for ground without a position.
std::shared_ptr<const EarthFrame> frame_of_ground(
    const std::optional<CoordinateSystem>& system, const std::optional<GeoPosition>& place);

} // namespace octant::models::heights
