#pragma once

#include "visuals/nature/daylight.h"
#include "visuals/nature/standing_mesh.h"

#include <cstdint>

namespace octant::visuals::nature {

struct House {
    GroundAnchor anchor;
    float half_m = 5.0F;       ///< its size: the circle that holds it has house_radius times that
    float height_share = 1.0F; ///< how much of the height there is yet
    float height_px = 1.0F;    ///< in the picture
    float sun = 1.0F;          ///< the share of sunlight that the relief lets through
    std::uint32_t random_bits = 0;
};

inline constexpr float house_height_m = 7.5F;
inline constexpr float house_radius = 1.52F;

/// Appends a house with a gable roof that overhangs its walls; near ones have windows. From near to far, for every eye:
/// the plane through the eaves parts roof and walls, both of which are convex.
void add_house(const House& house, const Daylight& day, StandingMesh& to);

} // namespace octant::visuals::nature
