#pragma once

namespace octant {

/// A place on the WGS 84 ellipsoid, degrees. Its latitude is geodetic.
struct GeoPlace {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
};

/// The shape of that ellipsoid.
namespace wgs84 {

inline constexpr double semi_major_m = 6378137.0;
inline constexpr double flattening = 1.0 / 298.257223563;
/// The square of its first eccentricity.
inline constexpr double e2 = flattening * (2.0 - flattening);

} // namespace wgs84

} // namespace octant
