#pragma once

namespace octant::flightpaths {

/// The geodetic latitude of a place from its geocentric one, which is up to 0.19 degrees or 21 km
/// less, and its height above the ellipsoid.
double geodetic_from_geocentric_deg(double geocentric_deg, double height_m);

} // namespace octant::flightpaths
