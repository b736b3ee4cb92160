#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace octant::sim {

/// What an aircraft can fly. A path that asks for more is refused (or clipped when asked to).
struct AircraftLimits {
    /// The limits of lift over weight, in g.
    double min_load_factor = 0.0;
    double max_load_factor = 0.0;
    /// The fastest change of the load factor (g onset), g/s.
    double load_factor_rate_gps = 0.0;
    /// The fastest roll.
    double roll_rate_radps = 0.0;
    /// The steepest bank; pi = no limit.
    double bank_rad = 0.0;
    double min_speed_mps = 0.0;
    double max_speed_mps = 0.0;
    /// The steepest climb that can be sustained.
    double climb_rate_mps = 0.0;
    /// The fastest change of speed along the path, up or down.
    double acceleration_mps2 = 0.0;
};

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
    /// How fast it turns about its body axes: roll, pitch and yaw rate.
    glm::dvec3 turn_rate_radps{0.0};
    /// False for an aircraft that nobody flies or whose track has not begun or has ended: nothing of it is shown.
    bool is_present = true;
};

} // namespace octant::sim
