#pragma once

#include "sim/base/earth_frame.h"

#include <array>
#include <complex>

namespace octant {

/// The transverse Mercator projection of scale 1 that touches a place's ellipsoid along the place's meridian; x and y
/// are 0 at the place. To 1e-6 m within 2,000 km of it, the poles included; lengths are drawn too long by d^2 / 2R^2 at
/// a distance d from the meridian, 1.2e-5 of them at 31 km.
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

/// The frame, or for none the one at 0 N, 0 E: where ground without a place is said to lie.
const EarthFrame& frame_or_at_zero(const EarthFrame* frame);

} // namespace octant
