#pragma once

#include "sim/base/geo_position.h"

#include <glm/vec2.hpp>

namespace octant {

/// Where a place is in a frame's axes.
struct FramePosition {
    glm::dvec2 east_north_m{0.0};
    /// The bearing of true north there, clockwise from the y axis: what is to be added to a heading from true north to
    /// have one from the y axis.
    double north_bearing_rad = 0.0;
};

/// How flat ground lies on the earth, or on the planet whose ellipsoid its origin names: where places are in its axes,
/// x east and y north in metres. For one thread at a time.
class EarthFrame {
public:
    virtual ~EarthFrame() = default;
    EarthFrame(const EarthFrame&) = delete;
    EarthFrame& operator=(const EarthFrame&) = delete;
    EarthFrame(EarthFrame&&) = delete;
    EarthFrame& operator=(EarthFrame&&) = delete;

    /// Where x and y are 0.
    virtual GeoPosition origin() const = 0;

    /// The ellipsoid of `place` is not looked at: its latitude and longitude are taken as the frame's. Finite for every
    /// place on the earth, and true up to 5,000 km from the origin.
    virtual glm::dvec2 local_from_geo(const GeoPosition& place) const = 0;

    /// Undoes local_from_geo() there; always a place on its ellipsoid.
    virtual GeoPosition geo_from_local(const glm::dvec2& east_north_m) const = 0;

    FramePosition place_of(const GeoPosition& place) const;

protected:
    EarthFrame() = default;
};

} // namespace octant
