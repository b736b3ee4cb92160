#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace octant::sim {

/// Motion of one aircraft at one time. World: x east, y north, z up (sim/base/axes.h).
struct AircraftState {
    double time_s = 0.0;
    /// The place of the aircraft's reference point, world axes.
    glm::dvec3 position_m{0.0};
    /// World axes.
    glm::dvec3 velocity_mps{0.0};
    /// A unit quaternion; body axes are x forward, y right, z down.
    glm::dquat body_to_world{1.0, 0.0, 0.0, 0.0};
    /// Lift over weight, in g.
    double load_factor = 1.0;
    /// The change of speed along the path, smoothed over about a second; with climb, drag and weight it says how much
    /// thrust the motion needs (flight_models.h).
    double speed_rate_mps2 = 0.0;
};

} // namespace octant::sim
