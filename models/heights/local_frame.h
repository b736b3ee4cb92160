#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace octant::models::heights {

struct TransformationDeleter {
    void operator()(void* transformation) const;
};

/// Owner of an OGRCoordinateTransformationH.
using Transformation = std::unique_ptr<void, TransformationDeleter>;

/// An OGRSpatialReferenceH, owned elsewhere.
using SpatialReferenceHandle = void*;

/// A counted OGRSpatialReferenceH of our own.
using SpatialReference = std::shared_ptr<void>;

/// Where a grid's sample of a column and row lies in its coordinate system, in the system's units: x = x0 + x_column *
/// column + x_row * row, and y alike.
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

    /// Columns run east and rows north, or against that.
    bool is_upright() const { return x_row == 0.0 && y_column == 0.0; }

    /// The lengths of a column's and a row's step.
    glm::dvec2 steps() const;

    /// Column and row as x and y of a place. The grid has an area.
    GridTransform inverse() const;
};

/// A system as well-known text; empty when it cannot be written.
std::string wkt_of(SpatialReferenceHandle system);

/// The ellipsoid that a system counts latitudes on, from its text; WGS 84 for every system of the earth and for one
/// that names no ellipsoid.
Ellipsoid ellipsoid_of(const std::string& wkt);

/// An ellipsoid's latitude and longitude in degrees, longitude first.
SpatialReference geographic_coordinate_system(const Ellipsoid& ellipsoid);

/// What ImportOptions::system says of files whose axes are in metres without a place on the earth.
inline constexpr std::string_view local_metres_name = "metres";

/// A system by a name that ImportOptions::system may have. Throws Error for other names.
SpatialReference coordinate_system_from_name(const std::string& name);

/// The system of a ground; null where its text is not understood.
SpatialReference coordinate_system_of(const CoordinateSystem& system);

/// A copy of a system that lives as long as it is wanted.
SpatialReference spatial_reference_of(SpatialReferenceHandle system);

/// The transverse Mercator projection of scale 1 that touches a place: x is east and y is north of it, in metres. Null
/// where there is none.
SpatialReference local_coordinate_system(const GeoPosition& place);

/// Null when one system cannot be brought to the other.
Transformation between(SpatialReferenceHandle from, SpatialReferenceHandle to);

/// Moves points, each x and y in their place; those that cannot be moved become NaN. Does nothing with a null
/// transformation.
void transform_points(const Transformation& by, std::span<double> x, std::span<double> y);

/// Nothing when the point cannot be moved.
std::optional<glm::dvec2> moved(const Transformation& by, glm::dvec2 point);

/// How far a system is from being true to the ground.
struct ProjectionDistortion {
    double scale_percent = 0.0; ///< how much too long or short a length is drawn, at most
    double turn_deg = 0.0;      ///< how far its north lies off true north, at most
};

/// At the four corners of a field that lies so in a system. Nothing where the system does not know its place on the
/// earth.
std::optional<ProjectionDistortion> distortion_at_corners(
    const CoordinateSystem& system, const glm::dvec2& half_extent_m);

} // namespace octant::models::heights
