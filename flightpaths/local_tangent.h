#pragma once

#include "sim/base/geo_place.h"

#include <glm/vec2.hpp>

namespace octant::flightpaths {

/// Metres east and north of the origin, and back. The earth is taken as flat around the origin,
/// with the ellipsoid's two radii of curvature there: 1e-4 of the distance at 20 km, and the two
/// functions undo each other exactly. Not for the poles.
glm::dvec2 local_from_geo(const GeoPlace& origin, double latitude_deg, double longitude_deg);
GeoPlace geo_from_local(const GeoPlace& origin, const glm::dvec2& east_north_m);

/// The geodetic latitude of a place from its geocentric one, which is up to 0.19 degrees or 21 km
/// less, and its height above the ellipsoid.
double geodetic_from_geocentric_deg(double geocentric_deg, double height_m);

} // namespace octant::flightpaths
