#include "sim/piloted_flight.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/flight_models.h"
#include "sim/flight_steps.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::sim {

namespace {

constexpr double level_rad = rad_from_deg(0.2);
constexpr double level_climb_mps = 0.3;
constexpr int level_for_steps = steps_per_second / 2;
/// The bank is taken out with this time constant, the climb angle with the next.
constexpr double roll_out_s = 0.8;
constexpr double pull_out_s = 2.0;
constexpr double fastest_pull_radps = rad_from_deg(8.0);
/// Banked steeper than this a pull does not raise the nose much.
constexpr double pulling_bank_rad = rad_from_deg(70.0);
constexpr double gentlest_load_factor = 0.3;
constexpr double hardest_load_factor = 4.5;
/// A nose this far down gathers speed where there is too little of it.
constexpr double diving_rad = rad_from_deg(-12.0);
constexpr double throttle_per_mps = 0.02;
constexpr double collective_per_mps = 0.04;
constexpr double min_power_mps = mps_from_kt(60.0);
constexpr double speeding_up_pitch = 0.5;

double bank_rad(const AircraftState& state) { return euler_from_body_to_world(state.body_to_world).roll_rad; }

double climb_angle_rad(const AircraftState& state) {
    const glm::dvec3& v = state.velocity_mps;
    return std::atan2(v.z, std::hypot(v.x, v.y));
}

} // namespace

LevellingAutopilot::LevellingAutopilot(const AircraftKind& kind, const AircraftState& start)
    : kind_(kind), speed_mps_(std::clamp(glm::length(start.velocity_mps), kind.min_handover_speed_mps,
                       std::max(kind.min_handover_speed_mps, 0.9 * kind.limits.max_speed_mps))) {}

/// What holds height and speed in level flight at that height.
double LevellingAutopilot::trim_throttle(const AircraftState& state, double speed_mps) const {
    return make_piloted_flight(kind_, trimmed_state(kind_, state.position_m, 0.0, speed_mps))->trim_throttle();
}

PilotControls LevellingAutopilot::fixed_wing(const AircraftState& state) const {
    const double speed_mps = glm::length(state.velocity_mps);
    const double bank = bank_rad(state);
    const double climb = climb_angle_rad(state);
    const AircraftLimits& limits = kind_.limits;
    PilotControls controls;
    controls.roll = std::clamp(-bank / (roll_out_s * limits.roll_rate_radps), -1.0, 1.0);
    controls.throttle = trim_throttle(state, speed_mps_) + throttle_per_mps * (speed_mps_ - speed_mps);
    const double slow = std::max(0.0, 1.0 - speed_mps / kind_.min_handover_speed_mps);
    const double wanted_climb = std::max(diving_rad, 4.0 * slow * diving_rad);
    const double turning_radps =
        std::clamp((wanted_climb - climb) / pull_out_s, -fastest_pull_radps, fastest_pull_radps);
    const double centred = std::cos(climb);
    double load_factor = centred;
    if (std::abs(bank) < pulling_bank_rad) {
        load_factor = (centred + speed_mps * turning_radps / gravity_mps2) / std::cos(bank);
    }
    // What the wing has at this speed, with a margin to its stall.
    const double fast = speed_mps / limits.min_speed_mps;
    const double most = std::clamp(fast * fast, gentlest_load_factor, hardest_load_factor);
    load_factor = std::clamp(load_factor, gentlest_load_factor, most);
    const double range = load_factor > centred ? limits.max_load_factor - centred : centred - limits.min_load_factor;
    controls.pitch = std::clamp((load_factor - centred) / range, -1.0, 1.0);
    return controls;
}

/// Its centred cyclic levels it; the collective stops its climb. Where that is not enough to stop it sinking, as in a
/// hover high up, it gathers speed, at which a rotor needs less power.
PilotControls LevellingAutopilot::helicopter(const AircraftState& state) const {
    const double speed_mps = std::hypot(state.velocity_mps.x, state.velocity_mps.y);
    PilotControls controls;
    controls.throttle = trim_throttle(state, speed_mps) - collective_per_mps * state.velocity_mps.z;
    if (speed_mps < min_power_mps) { controls.pitch = -std::clamp(controls.throttle - 1.0, 0.0, speeding_up_pitch); }
    return controls;
}

PilotControls LevellingAutopilot::controls(const AircraftState& state) {
    PilotControls controls = kind_.flight_model == FlightModel::Helicopter ? helicopter(state) : fixed_wing(state);
    controls.throttle = std::clamp(controls.throttle, 0.0, 1.0);
    const bool is_level = std::abs(bank_rad(state)) < level_rad && std::abs(state.velocity_mps.z) < level_climb_mps;
    level_steps_ = is_level ? level_steps_ + 1 : 0;
    return is_done() ? PilotControls{.throttle = trim_throttle(state, glm::length(state.velocity_mps))} : controls;
}

bool LevellingAutopilot::is_done() const { return level_steps_ >= level_for_steps; }

} // namespace octant::sim
