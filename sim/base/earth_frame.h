#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <complex>
#include <optional>
#include <string>

namespace octant {

/// The figure of a planet or moon: an ellipsoid of revolution, by default that of WGS 84.
struct Ellipsoid {
    double semi_major_m = 6378137.0;
    double flattening = 1.0 / 298.257223563;

    /// The square of the first eccentricity.
    constexpr double e2() const { return flattening * (2.0 - flattening); }

    constexpr double semi_minor_m() const { return semi_major_m * (1.0 - flattening); }

    /// The radius of curvature of the ground: the mean of the three semi-axes, rounded to a kilometre; 6,371 km for the
    /// earth.
    double mean_radius_m() const;

    /// True for an ellipsoid of the earth: within 1 % of its size.
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

/// The ellipsoid of a ground; the earth's for generated ground, which has no position.
inline Ellipsoid ellipsoid_below(const std::optional<GeoPosition>& place) { return place ? place->ellipsoid : wgs84; }

/// Where a place is in a frame's axes.
struct FramePosition {
    glm::dvec2 east_north_m{0.0};
    /// The bearing of true north there, clockwise from the y axis. Added to a heading from true north, it gives the
    /// heading from the y axis.
    double north_bearing_rad = 0.0;
};

/// The map between positions on the earth, or on the planet of the origin's ellipsoid, and the axes of flat ground: x
/// east and y north in metres. For one thread at a time.
class EarthFrame {
public:
    virtual ~EarthFrame() = default;
    EarthFrame(const EarthFrame&) = delete;
    EarthFrame& operator=(const EarthFrame&) = delete;
    EarthFrame(EarthFrame&&) = delete;
    EarthFrame& operator=(EarthFrame&&) = delete;

    /// Where x and y are 0.
    virtual GeoPosition origin() const = 0;

    /// Ignores the ellipsoid of `place`: latitude and longitude are those of the frame's ellipsoid. Finite for every
    /// place on the earth, and exact up to 5,000 km from the origin.
    virtual glm::dvec2 local_from_geo(const GeoPosition& place) const = 0;

    /// The inverse of local_from_geo() within that distance; always a position on the ellipsoid.
    virtual GeoPosition geo_from_local(const glm::dvec2& east_north_m) const = 0;

    FramePosition place_of(const GeoPosition& place) const;

protected:
    EarthFrame() = default;
};

/// The transverse Mercator projection of scale 1 that touches a place's ellipsoid along the place's meridian; x and y
/// are 0 at the place. Exact to 1e-6 m within 2,000 km of it, the poles included. Lengths at a distance d from the
/// meridian are too long by the share d^2 / 2R^2, 1.2e-5 at 31 km.
class TransverseMercator final : public EarthFrame {
public:
    /// Coefficients of the sines of 2, 4, 6 and 8 times an angle.
    using Series = std::array<double, 4>;

    explicit TransverseMercator(const GeoPosition& origin);

    GeoPosition origin() const override { return origin_; }

    glm::dvec2 local_from_geo(const GeoPosition& place) const override;
    GeoPosition geo_from_local(const glm::dvec2& east_north_m) const override;

private:
    /// Metres along the meridian (real) and across it, a longitude away from it.
    std::complex<double> project(double latitude_deg, double away_rad) const;

    GeoPosition origin_;
    double mean_radius_m_ = 0.0; ///< of a sphere with meridians as long
    Series from_sphere_ = {};
    Series to_sphere_ = {};
    /// Of the origin, along its meridian.
    double north_of_equator_m_ = 0.0;
};

/// The frame, or if it is null the one at 0 N, 0 E, where ground without a position is placed.
const EarthFrame& frame_or_at_zero(const EarthFrame* frame);

} // namespace octant
