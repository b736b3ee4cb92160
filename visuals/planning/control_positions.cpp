#include "visuals/planning/control_positions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::planning {

namespace {

/// From -1 to 1: half of `full` deflects by 0.7 of all.
double deflection(double value, double full) {
    const double share = 2.0 * value / full;
    return share / std::sqrt(1.0 + share * share);
}

/// 1 below `from`, 0 above `to`.
double below(double value, double from, double to) { return 1.0 - glm::smoothstep(from, to, value); }

constexpr double gravity_mps2 = 9.80665;
constexpr double full_roll_radps = 2.0;
constexpr double full_load_g = 4.0;
constexpr double full_pitch_radps = 1.0;
constexpr double full_yaw_radps = 0.5;

} // namespace

models::ControlPositions control_positions(const sim::AircraftState& state, const landscape::Ground& ground) {
    using enum models::FlightControl;
    models::ControlPositions positions{};
    const auto at = [&](models::FlightControl control) -> double& {
        return positions[static_cast<std::size_t>(control)];
    };
    const glm::dvec3& turn_radps = state.turn_rate_radps;
    const double speed_mps = glm::length(state.velocity_mps);
    at(Roll) = deflection(turn_radps.x, full_roll_radps);
    at(Pitch) = deflection((state.load_factor - 1.0) / full_load_g + turn_radps.y / full_pitch_radps, 2.0);
    constexpr double slowest_turn_mps = 20.0; // below, turns are not flown by bank
    if (speed_mps > slowest_turn_mps) {
        const double right_wing_down = -(state.body_to_world * glm::dvec3(0.0, 1.0, 0.0)).z;
        at(Yaw) = deflection(turn_radps.z - gravity_mps2 * right_wing_down / speed_mps, full_yaw_radps);
    }
    at(SpeedBrake) = glm::smoothstep(3.0, 8.0, -state.speed_rate_mps2);
    const auto ground_m = ground.height_at(state.position_m.x, state.position_m.y);
    if (ground_m && std::isfinite(ground.mean_height_m())) {
        const double height_m = state.position_m.z - *ground_m; // of the reference point
        at(Gear) = below(height_m, 105.0, 120.0) * below(speed_mps, 105.0, 115.0); // seldom half-way
        at(Flaps) = 0.7 * below(height_m, 150.0, 300.0) * below(speed_mps, 85.0, 115.0);
    }
    return positions;
}

} // namespace octant::visuals::planning
