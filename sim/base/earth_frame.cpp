#include "sim/base/earth_frame.h"

#include <cmath>

namespace octant {

FramePosition EarthFrame::place_of(const GeoPosition& place) const {
    const double aside_deg = place.latitude_deg > 0.0 ? -1e-4 : 1e-4; // 11 m, away from the pole
    const glm::dvec2 at_m = local_from_geo(place);
    const glm::dvec2 beside_m = local_from_geo({place.latitude_deg + aside_deg, place.longitude_deg});
    const glm::dvec2 north_m = aside_deg > 0.0 ? beside_m - at_m : at_m - beside_m;
    return {at_m, std::atan2(north_m.x, north_m.y)};
}

} // namespace octant
