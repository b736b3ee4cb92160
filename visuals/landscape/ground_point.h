#pragma once

#include <glm/vec3.hpp>

namespace octant::visuals::landscape {

/// A place on the ground.
struct TerrainPoint {
    /// East and north of the field's south-west corner.
    float east_m = 0.0F;
    float north_m = 0.0F;
    /// Above datum.
    float height_m = 0.0F;
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    /// Of water: the share of its surroundings that is land.
    float land_share = 0.0F;
};

} // namespace octant::visuals::landscape
