// A point mass under lift, drag, side force, thrust and gravity, with an attitude that a control augmentation system
// turns: any text on flight mechanics, e.g. Stengel, Flight Dynamics (2004). Steps by the midpoint rule. Load-factor
// and roll-rate limits: sim/aircraft_kind.cpp; sources of the forces are below. Deviations: no moments
// of inertia. The attitude turns with the velocity, and about it with the lags below, chosen for a fighter that handles
// well. Less than full_authority_mps of airspeed leaves the tail less and less to turn with.
//
// Sources, all public:
// - Wing 56.5 m2 (608 ft2), aspect ratio 3, leading edge swept 45 degrees; empty 12,700 kg: data
//   sheets of the F-15C. 17,000 kg is that with a pilot, missiles and about half the inside fuel.
// - Slope of the lift: Helmbold's formula for swept wings gives 3.1 per radian for the bare wing;
//   4.0 allows for the broad body. Drag of a plate across the wind: Hoerner, Fluid-Dynamic Drag.
// - Thrust with height and Mach number: Mattingly, Heiser and Pratt, Aircraft Engine Design, 2nd
//   ed., ch. 2, low-bypass mixed turbofan, for the 23,770 lb of the F100-PW-220 with reheat.
// - Dry thrust over thrust with reheat: the tables of an engine of that family in Nguyen et al.,
//   NASA TP-1538 (1979), printed in Stevens and Lewis, Aircraft Control and Simulation, app. A.
//   From sea level to 20,000 ft it falls from 0.57 .. 0.63 at rest to 0.47 .. 0.49 at Mach 0.8.
// Deviations: angle and size of the most lift, zero-lift and wave drag are chosen so that a stall at about 115 kt, the
// published 800 kt (M 1.2) low down, the climb of the 50,000 ft/min class and M 2 at height come out roughly. Lift does
// not depend on the Mach number. Idle gives no net thrust.

#include "sim/fixed_wing_flight.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::sim::f15 {

namespace {

constexpr double broken_rad = rad_from_deg(36.0);
constexpr double bend_rad = stall_alpha_rad - linear_alpha_rad;
constexpr double plate_drag = 1.9;
constexpr double side_slope = 0.9; // side force per radian of sideslip
constexpr double induced_factor = 0.13;

constexpr double dry_lever = 0.8;
constexpr double installed_share = 0.92;
constexpr double throttle_ratio = 1.07;
constexpr double static_thrust_n = 2.0 * 23770.0 * 4.4482216 * installed_share;

double zero_lift_drag(double mach) {
    return 0.0215 + 0.0185 * smooth_step(0.85, 1.15, mach) - 0.012 * smooth_step(1.15, 2.2, mach);
}

/// Dry thrust over thrust with reheat.
double dry_share(double mach) { return std::clamp(0.62 - 0.18 * mach, 0.35, 0.62); }

double full_thrust_n(double mach, const Air& air) {
    const double ram = 1.0 + 0.2 * mach * mach;
    const double total_pressure = air.pressure_ratio * std::pow(ram, 3.5);
    const double total_temperature = air.temperature_ratio * ram;
    const double hot = std::max(0.0, total_temperature - throttle_ratio);
    return static_thrust_n * total_pressure * std::max(0.0, 1.0 - 3.5 * hot / total_temperature);
}

} // namespace

double lift_coefficient(double alpha_rad) {
    const double size_rad = std::abs(alpha_rad);
    double lift = lift_slope * size_rad;
    if (size_rad > linear_alpha_rad) {
        const double to_peak = stall_alpha_rad - std::min(size_rad, stall_alpha_rad);
        lift = max_lift_coefficient - 0.5 * lift_slope / bend_rad * to_peak * to_peak;
    }
    if (size_rad > stall_alpha_rad) {
        const double plate = plate_drag * std::sin(size_rad) * std::abs(std::cos(size_rad));
        lift += smooth_step(stall_alpha_rad, broken_rad, size_rad) * (plate - lift);
    }
    return std::copysign(lift, alpha_rad);
}

double alpha_for_lift(double coefficient) {
    const double size = std::min(std::abs(coefficient), max_lift_coefficient);
    const double alpha_rad =
        size <= lift_slope * linear_alpha_rad
            ? size / lift_slope
            : stall_alpha_rad - std::sqrt((max_lift_coefficient - size) * 2.0 * bend_rad / lift_slope);
    return std::copysign(alpha_rad, coefficient);
}

double drag_coefficient(double alpha_rad, double beta_rad, double mach) {
    const double lift = lift_coefficient(alpha_rad);
    const double attached = induced_factor * lift * lift;
    const double across = std::sin(alpha_rad);
    const double plate = 0.12 + plate_drag * across * across;
    const double broken = smooth_step(linear_alpha_rad, stall_alpha_rad, std::abs(alpha_rad));
    const double aside = std::sin(beta_rad);
    return zero_lift_drag(mach) + attached + broken * (plate - attached) + aside * aside;
}

double side_coefficient(double beta_rad) { return -side_slope * std::sin(beta_rad) * std::cos(beta_rad); }

double thrust_n(double lever, double mach, const Air& air) {
    const double dry = dry_share(mach);
    const double share =
        lever <= dry_lever ? dry * lever / dry_lever : dry + (1.0 - dry) * (lever - dry_lever) / (1.0 - dry_lever);
    return share * full_thrust_n(mach, air);
}

double lever_for_thrust(double newtons, double mach, const Air& air) {
    const double full_n = full_thrust_n(mach, air);
    const double dry = dry_share(mach);
    const double share = full_n > 0.0 ? std::clamp(newtons / full_n, 0.0, 1.0) : 1.0;
    return share <= dry ? share / dry * dry_lever : dry_lever + (share - dry) / (1.0 - dry) * (1.0 - dry_lever);
}

double reheat_from_lever(double lever) { return std::clamp((lever - dry_lever) / (1.0 - dry_lever), 0.0, 1.0); }

} // namespace octant::sim::f15

namespace octant::sim {

namespace {

constexpr double weight_n = f15::mass_kg * gravity_mps2;
constexpr double no_authority_mps = 10.0;
constexpr double full_authority_mps = 40.0;
/// Below this airspeed the roll rate falls with the airspeed.
constexpr double full_roll_mps = 170.0;
constexpr double load_factor_lag_s = 0.15;
constexpr double roll_lag_s = 0.2;
constexpr double rudder_lag_s = 0.4;
constexpr double engine_lag_s = 0.8;
constexpr double incidence_lag_s = 0.8;
/// Time constant by which errors of angle of attack and sideslip fade.
constexpr double attitude_lag_s = 0.1;
constexpr double fastest_pitch_radps = 1.2;
constexpr double full_rudder_rad = rad_from_deg(6.0);
/// Angle of attack that asking for a tenth more than the wing has adds, and its most, with the stick centred and all
/// the way back.
constexpr double beyond_stall_rad = rad_from_deg(4.0);
constexpr double centred_beyond_rad = rad_from_deg(4.0);
constexpr double pulled_beyond_rad = rad_from_deg(12.0);

// What the aircraft does by itself after a stall, until it flies level again.
/// The wing has to have this much lift before the nose comes all the way up.
constexpr double safe_load_factor = 2.5;
constexpr double dive_rad_per_g = rad_from_deg(25.0);
constexpr double steepest_recovery_rad = rad_from_deg(40.0);
constexpr double recovery_lag_s = 2.0;
constexpr double fastest_recovery_radps = rad_from_deg(8.0);
/// Of the wing's lift; the rest is the margin to the next stall.
constexpr double recovery_share = 0.7;
constexpr double min_upright = 0.4;
constexpr double moved_stick = 0.05;
constexpr double level_again_rad = rad_from_deg(0.2);

const glm::dvec3 body_forward(1.0, 0.0, 0.0);
const glm::dvec3 body_right(0.0, 1.0, 0.0);
const glm::dvec3 body_down(0.0, 0.0, 1.0);

double authority(double speed_mps) {
    return std::clamp((speed_mps - no_authority_mps) / (full_authority_mps - no_authority_mps), 0.0, 1.0);
}

/// The lift at a lift coefficient of 1.
double lift_scale_n(const Air& air, double speed_mps) {
    return 0.5 * air.density_kgpm3 * speed_mps * speed_mps * f15::wing_m2;
}

struct Trim {
    double alpha_rad = 0.0;
    double lever = 0.0;
};

/// Level flight without acceleration: thrust along the body holds the drag and some weight.
Trim level_trim(double speed_mps, const Air& air) {
    const double scale_n = lift_scale_n(air, speed_mps);
    const double mach = speed_mps / air.speed_of_sound_mps;
    Trim trim;
    if (!(scale_n > 0.0)) { return trim; }
    double thrust_n = 0.0;
    for (int i = 0; i < 60; ++i) {
        const double lift_n = weight_n - thrust_n * std::sin(trim.alpha_rad);
        trim.alpha_rad =
            f15::alpha_for_lift(std::clamp(lift_n / scale_n, -f15::max_lift_coefficient, f15::max_lift_coefficient));
        thrust_n = scale_n * f15::drag_coefficient(trim.alpha_rad, 0.0, mach) / std::cos(trim.alpha_rad);
    }
    trim.lever = f15::lever_for_thrust(thrust_n, mach, air);
    return trim;
}

} // namespace

AircraftState trimmed_fixed_wing(const glm::dvec3& position_m, double heading_rad, double speed_mps) {
    assert(speed_mps >= 0.0);
    const Trim trim = level_trim(speed_mps, standard_air(position_m.z));
    return level_state(position_m, heading_rad, trim.alpha_rad, speed_mps);
}

FixedWingFlight::FixedWingFlight(const AircraftLimits& limits, const AircraftState& start)
    : limits_(limits), state_(start), clock_(start.time_s), air_(standard_air(start.position_m.z)) {
    flow_ = flow(start.velocity_mps, start.body_to_world, 0.0);
    trim_throttle_ = level_trim(flow_.speed_mps, air_).lever;
    lever_ = trim_throttle_;
    flow_ = flow(start.velocity_mps, start.body_to_world, 0.0);
    commanded_load_factor_ = std::clamp(start.load_factor, limits_.min_load_factor, limits_.max_load_factor);
    commanded_alpha_rad_ = alpha_for_load_factor(commanded_load_factor_, flow_.speed_mps, 0.0);
    warnings_ = {}; // nothing has been flown yet
    if (flow_.speed_mps > full_authority_mps) {
        incidence_rad_ = commanded_alpha_rad_ - flow_.alpha_rad;
    } else {
        commanded_alpha_rad_ = flow_.alpha_rad;
    }
    commanded_sideslip_rad_ = std::clamp(flow_.beta_rad, -full_rudder_rad, full_rudder_rad);
    flow_ = flow(start.velocity_mps, start.body_to_world, incidence_rad_);
}

FixedWingFlight::Flow FixedWingFlight::flow(
    const glm::dvec3& velocity_mps, const glm::dquat& attitude, double incidence_rad) const {
    Flow flow;
    flow.speed_mps = glm::length(velocity_mps);
    const double mach = flow.speed_mps / air_.speed_of_sound_mps;
    const glm::dvec3 thrust_n = f15::thrust_n(lever_, mach, air_) * (attitude * body_forward);
    const glm::dvec3 gravity_n(0.0, 0.0, -weight_n);
    if (!(flow.speed_mps > 1e-3)) {
        flow.acceleration_mps2 = (thrust_n + gravity_n) / f15::mass_kg;
        return flow;
    }
    flow.along = velocity_mps / flow.speed_mps;
    const glm::dvec3 in_body = glm::conjugate(attitude) * flow.along;
    flow.alpha_rad = std::atan2(in_body.z, in_body.x);
    flow.beta_rad = std::asin(std::clamp(in_body.y, -1.0, 1.0));
    const glm::dvec3 up = attitude * -body_down;
    const glm::dvec3 across = up - glm::dot(up, flow.along) * flow.along;
    const double across_size = glm::length(across);
    const glm::dvec3 lifting = across_size > 1e-6 ? across / across_size : glm::dvec3(0.0);
    const double scale_n = lift_scale_n(air_, flow.speed_mps);
    const double alpha_rad = flow.alpha_rad + incidence_rad;
    flow.thrust_lift_n = glm::dot(thrust_n, lifting);
    const double lift_n =
        std::clamp(scale_n * f15::lift_coefficient(alpha_rad), limits_.min_load_factor * weight_n - flow.thrust_lift_n,
            limits_.max_load_factor * weight_n - flow.thrust_lift_n);
    const double drag_n = scale_n * f15::drag_coefficient(alpha_rad, flow.beta_rad, mach);
    const double side_n = scale_n * f15::side_coefficient(flow.beta_rad);
    flow.load_factor = (lift_n + flow.thrust_lift_n) / weight_n;
    flow.acceleration_mps2 =
        (lift_n * lifting - drag_n * flow.along + side_n * glm::cross(flow.along, lifting) + thrust_n + gravity_n) /
        f15::mass_kg;
    return flow;
}

/// Angle of attack, with incidence, that gives a load factor: beyond the stall when the wing has not that much. Sets
/// the warning of a stall.
double FixedWingFlight::alpha_for_load_factor(double load_factor, double speed_mps, double pull) {
    const double scale_n = std::max(1.0, lift_scale_n(air_, speed_mps));
    const double wanted = (load_factor * weight_n - flow_.thrust_lift_n) / scale_n;
    const double share = std::abs(wanted) / f15::max_lift_coefficient;
    warnings_.stalled = share > 1.0;
    double alpha_rad = f15::alpha_for_lift(wanted);
    if (warnings_.stalled) {
        const double max_rad = centred_beyond_rad + (pulled_beyond_rad - centred_beyond_rad) * std::abs(pull);
        const double beyond_rad = std::min(max_rad, (share - 1.0) * 10.0 * beyond_stall_rad);
        alpha_rad += std::copysign(beyond_rad, wanted);
    }
    return alpha_rad * authority(speed_mps);
}

/// Rate of the attitude in world axes: with the velocity, about it as the pilot rolls, and towards the asked angles of
/// attack and sideslip. `share` of the step has passed.
glm::dvec3 FixedWingFlight::turn_radps(
    const Flow& flow, const glm::dquat& attitude, const PitchStep& pitching, double share) const {
    const double held = authority(flow.speed_mps);
    if (held == 0.0) { return glm::dvec3(0.0); }
    const glm::dvec3 with_path = glm::cross(flow.along, flow.acceleration_mps2) / flow.speed_mps;
    const double asked_rad = pitching.from_rad + share * (pitching.to_rad - pitching.from_rad);
    const double incidence_rad =
        pitching.incidence_from_rad + share * (pitching.incidence_to_rad - pitching.incidence_from_rad);
    const double course_radps =
        (pitching.to_rad - pitching.from_rad - (pitching.incidence_to_rad - pitching.incidence_from_rad)) / step_s;
    const double error_rad = wrapped_to_pi(asked_rad - incidence_rad - flow.alpha_rad);
    const double pitch_radps =
        std::clamp(course_radps + error_rad / attitude_lag_s, -fastest_pitch_radps, fastest_pitch_radps);
    const double yaw_radps = std::clamp(
        (flow.beta_rad - commanded_sideslip_rad_) / attitude_lag_s, -fastest_pitch_radps, fastest_pitch_radps);
    return held * (with_path + roll_radps_ * flow.along + pitch_radps * (attitude * body_right) +
                      yaw_radps * (attitude * body_down));
}

/// The load factor at which the wing stalls.
double FixedWingFlight::max_load_factor() const {
    return lift_scale_n(air_, flow_.speed_mps) * f15::max_lift_coefficient / weight_n;
}

bool FixedWingFlight::is_safe(double climb_rad) const {
    return std::abs(climb_rad) < level_again_rad && max_load_factor() > safe_load_factor;
}

/// The load factor of a centred stick after a stall: it brings the climb angle to one at which the aircraft gathers the
/// speed it lacks, and to level flight once it has that.
double FixedWingFlight::recovery_load_factor(double climb_rad, double centred) const {
    const double most = max_load_factor();
    const double wanted_rad = -std::clamp((safe_load_factor - most) * dive_rad_per_g, 0.0, steepest_recovery_rad);
    const double up = -glm::dot(state_.body_to_world * body_down, glm::dvec3(0.0, 0.0, 1.0));
    if (up < min_upright) { return centred; }
    const double turning_radps =
        std::clamp((wanted_rad - climb_rad) / recovery_lag_s, -fastest_recovery_radps, fastest_recovery_radps);
    const double wanted = centred + flow_.speed_mps * turning_radps / gravity_mps2 / up;
    return std::clamp(wanted, 0.3, std::max(centred, recovery_share * most));
}

/// Moves what the flight controls ask for one step towards what the pilot's controls command.
void FixedWingFlight::set_commands(const PilotControls& controls) {
    const glm::dvec3& velocity = state_.velocity_mps;
    const double speed_mps = flow_.speed_mps;
    const double level = std::hypot(velocity.x, velocity.y);
    const double climb_rad = std::atan2(velocity.z, level);
    double centred = speed_mps > no_authority_mps ? level / speed_mps : 1.0;
    is_recovering_stall_ =
        warnings_.stalled || (is_recovering_stall_ && std::abs(controls.pitch) < moved_stick && !is_safe(climb_rad));
    if (is_recovering_stall_ && !warnings_.stalled) { centred = recovery_load_factor(climb_rad, centred); }
    const double range = controls.pitch >= 0.0 ? limits_.max_load_factor - centred : centred - limits_.min_load_factor;
    commanded_load_factor_ = first_order_lag(
        commanded_load_factor_, centred + controls.pitch * range, load_factor_lag_s, limits_.load_factor_rate_gps);
    const double max_roll_radps =
        limits_.roll_rate_radps * std::min(1.0, speed_mps / full_roll_mps) *
        (1.0 - 0.7 * smooth_step(rad_from_deg(15.0), f15::stall_alpha_rad, std::abs(flow_.alpha_rad)));
    roll_radps_ = first_order_lag(roll_radps_, controls.roll * max_roll_radps, roll_lag_s);
    roll_radps_ = std::clamp(roll_radps_, -max_roll_radps, max_roll_radps);
    commanded_sideslip_rad_ = first_order_lag(commanded_sideslip_rad_, -controls.yaw * full_rudder_rad, rudder_lag_s);
    warnings_.is_at_limit = commanded_load_factor_ > limits_.max_load_factor - 0.02 ||
                            commanded_load_factor_ < limits_.min_load_factor + 0.02 ||
                            std::abs(roll_radps_) > 0.99 * max_roll_radps || speed_mps > limits_.max_speed_mps;
}

void FixedWingFlight::move(const PitchStep& pitching) {
    const glm::dvec3 velocity = state_.velocity_mps;
    const glm::dquat attitude = state_.body_to_world;
    const double half_s = 0.5 * step_s;
    const glm::dquat half_turned = turned(attitude, turn_radps(flow_, attitude, pitching, 0.0), half_s);
    const Flow half = flow(velocity + half_s * flow_.acceleration_mps2, half_turned,
        0.5 * (pitching.incidence_from_rad + pitching.incidence_to_rad));
    state_.velocity_mps = velocity + step_s * half.acceleration_mps2;
    state_.position_m += half_s * (velocity + state_.velocity_mps);
    state_.body_to_world = turned(attitude, turn_radps(half, half_turned, pitching, 0.5), step_s);
}

void FixedWingFlight::step(const PilotControls& controls) {
    const PilotControls asked = clean(controls);
    set_commands(asked);
    const double coming_mps = std::max(0.0, flow_.speed_mps + step_s * glm::dot(flow_.along, flow_.acceleration_mps2));
    PitchStep pitching;
    pitching.from_rad = commanded_alpha_rad_;
    pitching.to_rad = alpha_for_load_factor(commanded_load_factor_, coming_mps, asked.pitch);
    pitching.incidence_from_rad = incidence_rad_;
    pitching.incidence_to_rad = first_order_lag(incidence_rad_, 0.0, incidence_lag_s);
    move(pitching);
    commanded_alpha_rad_ = pitching.to_rad;
    incidence_rad_ = pitching.incidence_to_rad;
    lever_ = first_order_lag(lever_, asked.throttle, engine_lag_s);
    air_ = standard_air(state_.position_m.z);
    flow_ = flow(state_.velocity_mps, state_.body_to_world, incidence_rad_);
    state_.load_factor = flow_.load_factor;
    state_.speed_rate_mps2 = glm::dot(flow_.along, flow_.acceleration_mps2);
    state_.time_s = clock_.next_s();
}

} // namespace octant::sim
