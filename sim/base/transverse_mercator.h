#pragma once

#include "sim/base/earth_frame.h"

namespace octant {

/// The transverse Mercator projection of scale 1 that touches the ellipsoid along the meridian of a
/// place, where x and y are 0. To 1e-6 m within 2,000 km of it, the poles included; lengths are
/// drawn too long by d^2 / 2R^2 at a distance d from the meridian, 1.2e-5 of them at 31 km.
class TransverseMercator final : public EarthFrame {
public:
    explicit TransverseMercator(const GeoPlace& origin);

    GeoPlace origin() const override { return origin_; }

    glm::dvec2 local_from_geo(const GeoPlace& place) const override;
    GeoPlace geo_from_local(const glm::dvec2& east_north_m) const override;

private:
    GeoPlace origin_;
    /// Of the origin, along its meridian.
    double north_of_equator_m_;
};

/// The frame, or for none the one at 0 N, 0 E: where ground without a place is said to lie.
const EarthFrame& frame_or_at_zero(const EarthFrame* frame);

} // namespace octant
