#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace octant::sim {

/// Motion of one aircraft at one time. World: x east, y north, z up (sim/base/axes.h).
struct AircraftState {
    double time_s = 0.0;
    glm::dvec3 position_m{0.0};                   ///< world, of the aircraft's reference point
    glm::dvec3 velocity_mps{0.0};                 ///< world
    glm::dquat body_to_world{1.0, 0.0, 0.0, 0.0}; ///< unit; body x forward, y right, z down
    double load_factor = 1.0;                     ///< lift over weight, in g
};

} // namespace octant::sim
