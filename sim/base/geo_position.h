#pragma once

#include <optional>
#include <string>

namespace octant {

/// The figure of a planet or moon, an ellipsoid of revolution: that of WGS 84 unless said.
struct Ellipsoid {
    double semi_major_m = 6378137.0;
    double flattening = 1.0 / 298.257223563;

    /// The square of the first eccentricity.
    constexpr double e2() const { return flattening * (2.0 - flattening); }

    constexpr double semi_minor_m() const { return semi_major_m * (1.0 - flattening); }

    /// The radius by which ground curves: the mean of the three semi-axes, to a kilometre, which is 6,371 km for the
    /// earth.
    double mean_radius_m() const;

    /// Whether it is one of the earth's ellipsoids: within 1 % of its size.
    bool is_earth() const;

    bool operator==(const Ellipsoid&) const = default;
};

inline constexpr Ellipsoid wgs84;

/// "the earth", "Mars", "the Moon", or "a body with a radius of 252 km". By its size.
std::string name_of_body(const Ellipsoid& ellipsoid);

/// A place on an ellipsoid, degrees. Its latitude is geodetic.
struct GeoPosition {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    Ellipsoid ellipsoid = {};
};

/// The ellipsoid below a ground; the earth's for made ground, which has no place.
inline Ellipsoid ellipsoid_below(const std::optional<GeoPosition>& place) { return place ? place->ellipsoid : wgs84; }

} // namespace octant
