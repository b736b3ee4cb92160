#pragma once

#include "sim/base/axes.h"
#include "sim/base/geo_position.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace octant::sim::links {

/// A place on or above the WGS 84 ellipsoid.
struct Geodetic {
    double latitude_rad = 0.0;
    double longitude_rad = 0.0;
    double height_m = 0.0;
};

/// Earth-centred, earth-fixed metres of a place, and back: to 1e-6 m between the centre's neighbourhood (1,000 km of it
/// are left out: there latitude has no sense) and any height.
glm::dvec3 ecef_from_geodetic(const Geodetic& place);
Geodetic geodetic_from_ecef(const glm::dvec3& ecef_m);

/// The place that lies a small way north, east and down of one on an ellipsoid.
Geodetic offset_by(const Geodetic& place, const glm::dvec3& ned_m, const Ellipsoid& ellipsoid);

/// Rotation that takes earth-fixed vectors to north, east, down at a place.
glm::dmat3 ned_from_ecef(const Geodetic& place);

/// Rotation of an aircraft with these angles: body to north, east, down.
glm::dmat3 ned_from_body(const EulerAngles& angles);

/// The angles of such a rotation.
EulerAngles euler_from_ned_from_body(const glm::dmat3& ned_from_body);

} // namespace octant::sim::links
