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

/// 1 below a threshold, 0 above; between them for so many seconds at the rate at which the value changes, and never
/// where it stays.
double below_in_passing(double value, double threshold, double rate_per_s, double passing_s) {
    const double half_width = 0.5 * std::abs(rate_per_s) * passing_s;
    if (half_width == 0.0) { return value < threshold ? 1.0 : 0.0; }
    return below(value, threshold - half_width, threshold + half_width);
}

constexpr double gravity_mps2 = 9.80665;
constexpr double full_roll_radps = 2.0;
constexpr double full_load_g = 4.0;
constexpr double full_pitch_radps = 1.0;
constexpr double full_yaw_radps = 0.5;

/// Down below 60 m, on an approach from 120 m on, and slower than 110 m/s; on the way for 5 s.
double gear_position(const sim::AircraftState& state, const landscape::Ground& ground, double ground_m) {
    constexpr double passing_s = 5.0;
    constexpr double lowest_m = 60.0;
    constexpr double of_approach_m = 120.0;
    constexpr double fastest_mps = 110.0;
    const glm::dvec3& velocity_mps = state.velocity_mps;
    const double ahead_m = ground.height_at(state.position_m.x + velocity_mps.x, state.position_m.y + velocity_mps.y)
                               .value_or(ground_m); // in a second
    const double descent = glm::smoothstep(0.5, 1.5, -velocity_mps.z);
    const double height_m = state.position_m.z - ground_m; // of the reference point
    return below_in_passing(
               height_m, glm::mix(lowest_m, of_approach_m, descent), velocity_mps.z - (ahead_m - ground_m), passing_s) *
           below_in_passing(glm::length(velocity_mps), fastest_mps, state.speed_rate_mps2, passing_s);
}

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
        at(Gear) = gear_position(state, ground, *ground_m);
        at(Flaps) = 0.7 * below(height_m, 150.0, 300.0) * below(speed_mps, 85.0, 115.0);
    }
    return positions;
}

} // namespace octant::visuals::planning
