#pragma once

#include <glm/vec3.hpp>

namespace octant::visuals::landscape {

/// A place on the ground.
struct GroundPoint {
    float east_m = 0.0F;   ///< of the field's south-west corner
    float north_m = 0.0F;  ///< of the field's south-west corner
    float height_m = 0.0F; ///< above datum
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    float shore = 0.0F; ///< of water: share of its surroundings that is land
};

} // namespace octant::visuals::landscape
