// A point mass under rotor thrust, drag and gravity, with the attitude command and the turn coordination in forward
// flight that ADS-33E-PRF describes. Steps by the midpoint rule. Limits: sim/aircraft_kind.cpp; sources of the thrust
// are below. Drag areas are chosen: 0.45 m2 (5 ft2) ahead, as is usual for a clean light helicopter, aside and below
// from the size of the body. Deviations: the thrust stands along the mast, so that disc and body tilt alike; no moments
// of inertia; no ground effect.
//
// Sources, all public:
// - 1,361 kg at most, 8.6 m/s of climb, 152 kt, five blades: data sheets of the 500MD. 420 shp of the
//   Allison 250-C20B, 375 shp through the gearbox: heli-archive.ch, "Hughes 500D".
// - Rotor 8.05 m across, blades 0.171 m deep, tips at 203 m/s (482 rpm): general knowledge of the
//   369D, not read in a source.
// - Thrust by blade elements, downwash by Glauert's momentum theory, induced and profile power: any
//   text on rotors, e.g. Leishman, Principles of Helicopter Aerodynamics, chapters 2, 3 and 5.
// Deviations: untwisted blades whose pitch is that at three quarters of the radius; lowest collective is no pitch, so
// that the rotor cannot do work on the aircraft then. Rotor speed never changes. No vortex ring. Power losses are
// chosen so that the published climb and speed come out.

#include "sim/helicopter_flight.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace octant::sim::md500 {

namespace {

constexpr double radius_m = 4.025;
constexpr double disc_m2 = pi * radius_m * radius_m;
constexpr double tip_mps = 203.0;
constexpr double solidity = 5.0 * 0.171 / (pi * radius_m);
constexpr double lift_slope = 5.7; // lift of a blade section per radian
constexpr double blade_drag = 0.010;
constexpr double max_pitch_rad = 0.22;
constexpr double induced_loss = 1.15;
constexpr double shaft_w = 375.0 * 745.7;
constexpr double engine_w = 420.0 * 745.7;
/// What the tail rotor, gears and fans leave of the engine's power.
constexpr double rotor_share = 0.845;

double pitch_share(double in_plane_mps) {
    const double advance = in_plane_mps / tip_mps;
    return 1.0 / 3.0 + 0.5 * advance * advance;
}

double thrust_scale_n(const Air& air) {
    return air.density_kgpm3 * disc_m2 * tip_mps * tip_mps * 0.5 * solidity * lift_slope;
}

double profile_w(double in_plane_mps, const Air& air) {
    const double advance = in_plane_mps / tip_mps;
    return air.density_kgpm3 * disc_m2 * tip_mps * tip_mps * tip_mps * solidity * blade_drag / 8.0 *
           (1.0 + 4.65 * advance * advance);
}

} // namespace

double blade_thrust_n(double collective, const RotorFlow& flow, const Air& air) {
    const double inflow = (flow.axial_mps + flow.induced_mps) / tip_mps;
    return thrust_scale_n(air) * (collective * max_pitch_rad * pitch_share(flow.in_plane_mps) - 0.5 * inflow);
}

double collective_for_thrust(double newtons, const RotorFlow& flow, const Air& air) {
    const double inflow = (flow.axial_mps + flow.induced_mps) / tip_mps;
    return (newtons / thrust_scale_n(air) + 0.5 * inflow) / (max_pitch_rad * pitch_share(flow.in_plane_mps));
}

double max_powered_thrust_n(const RotorFlow& flow, const Air& air) {
    const double power_w =
        rotor_share * std::min(shaft_w, engine_w * air.density_kgpm3 / standard_air(0.0).density_kgpm3);
    const double per_newton_mps = induced_loss * flow.induced_mps + flow.axial_mps;
    const double left_w = std::max(0.0, power_w - profile_w(flow.in_plane_mps, air));
    return per_newton_mps > 1e-3 ? left_w / per_newton_mps : std::numeric_limits<double>::infinity();
}

double steady_induced_mps(double newtons, const RotorFlow& flow, const Air& air) {
    const double hover2 = std::max(0.0, newtons) / (2.0 * air.density_kgpm3 * disc_m2);
    const double axial_mps = flow.axial_mps + flow.induced_mps;
    // Where the rotor sinks into its own wake momentum theory has no answer.
    const double min_mps = 0.5 * std::sqrt(hover2);
    const double wind_mps = std::max(std::hypot(flow.in_plane_mps, axial_mps), min_mps);
    return wind_mps > 0.0 ? hover2 / wind_mps : 0.0;
}

} // namespace octant::sim::md500

namespace octant::sim {

namespace {

constexpr double helicopter_weight_n = md500::mass_kg * gravity_mps2;
const glm::dvec3 drag_area_m2(0.45, 3.0, 2.5);
/// The disc blows back in a slow wind: deceleration by speed, gone at many times this speed.
constexpr double blow_back_per_s = 0.12;
constexpr double blow_back_mps = 8.0;

constexpr double pitch_range_rad = rad_from_deg(25.0);
constexpr double steepest_pitch_rad = rad_from_deg(35.0);
constexpr double helicopter_attitude_lag_s = 0.45;
constexpr double rate_lag_s = 0.12;
constexpr double max_helicopter_pitch_radps = rad_from_deg(40.0);
constexpr double fastest_yaw_radps = rad_from_deg(60.0);
constexpr double pedal_yaw_radps = rad_from_deg(50.0);
constexpr double pedal_sideslip_rad = rad_from_deg(10.0);
constexpr double sideslip_lag_s = 0.8;
constexpr double collective_lag_s = 0.25;
constexpr double downwash_lag_s = 0.15;
/// Below still_mps a centred cyclic stops the aircraft, above moving_mps it holds the speed.
constexpr double still_mps = 1.0;
constexpr double moving_mps = 4.0;
/// Below slow_mps the pedals turn on the spot, above fast_mps they command sideslip.
constexpr double slow_mps = 8.0;
constexpr double fast_mps = 18.0;
/// Nose-down cyclic fades out over this range below the never-exceed speed.
constexpr double speed_margin_mps = 5.0;
constexpr double pull_up_rad_per_mps = rad_from_deg(2.0);
constexpr double max_pull_up_rad = rad_from_deg(20.0);

const glm::dvec3 body_up(0.0, 0.0, -1.0);

/// Drag of the body and blow-back of the disc, in body axes.
glm::dvec3 drag_n(const glm::dvec3& body_mps, const Air& air) {
    const double speed_mps = glm::length(body_mps);
    const double slow = speed_mps / blow_back_mps;
    const double blow_back = md500::mass_kg * blow_back_per_s / (1.0 + slow * slow);
    const glm::dvec3 in_disc(body_mps.x, body_mps.y, 0.0);
    return -0.5 * air.density_kgpm3 * speed_mps * drag_area_m2 * body_mps - blow_back * in_disc;
}

/// Level, straight flight at a forward speed: nose-up pitch and thrust that hold it.
struct HelicopterTrim {
    double pitch_rad = 0.0;
    double thrust_n = helicopter_weight_n;
};

HelicopterTrim helicopter_trim(double forward_mps, const Air& air) {
    HelicopterTrim trim;
    for (int i = 0; i < 12; ++i) {
        const double c = std::cos(trim.pitch_rad);
        const double s = std::sin(trim.pitch_rad);
        const glm::dvec3 drag = drag_n({forward_mps * c, 0.0, forward_mps * s}, air);
        const double forward_n = drag.x * c + drag.z * s;
        const double up_n = drag.x * s - drag.z * c;
        trim.pitch_rad = std::atan2(forward_n, helicopter_weight_n - up_n);
        trim.thrust_n = std::hypot(forward_n, helicopter_weight_n - up_n);
    }
    return trim;
}

double sideslip_rad(const glm::dvec3& velocity_mps, double heading_rad) {
    return wrapped_to_pi(std::atan2(velocity_mps.x, velocity_mps.y) - heading_rad);
}

} // namespace

AircraftState trimmed_helicopter(const glm::dvec3& position_m, double heading_rad, double speed_mps) {
    assert(speed_mps >= 0.0);
    const HelicopterTrim trim = helicopter_trim(speed_mps, standard_air(position_m.z));
    return level_state(position_m, heading_rad, trim.pitch_rad, speed_mps);
}

HelicopterFlight::HelicopterFlight(const AircraftLimits& limits, const AircraftState& start)
    : limits_(limits), state_(start), clock_(start.time_s), air_(standard_air(start.position_m.z)) {
    const double level_mps = std::hypot(start.velocity_mps.x, start.velocity_mps.y);
    const HelicopterTrim trim = helicopter_trim(level_mps, air_);
    const double c = std::cos(trim.pitch_rad);
    const double s = std::sin(trim.pitch_rad);
    md500::RotorFlow level{-level_mps * s, level_mps * c, 0.0};
    for (int i = 0; i < 200; ++i) {
        level.induced_mps += 0.5 * (md500::steady_induced_mps(trim.thrust_n, level, air_) - level.induced_mps);
    }
    trim_collective_ = std::clamp(md500::collective_for_thrust(trim.thrust_n, level, air_), 0.0, 1.0);
    update_downwash();
    flow_ = flow(start.velocity_mps, start.body_to_world);
}

/// Collective and downwash that go with the load factor of the start.
void HelicopterFlight::update_downwash() {
    const glm::dvec3 body_mps = glm::conjugate(state_.body_to_world) * state_.velocity_mps;
    const glm::dvec3 drag = drag_n(body_mps, air_);
    const double felt_n = std::abs(state_.load_factor) * helicopter_weight_n;
    const double along_n = std::sqrt(std::max(0.0, felt_n * felt_n - drag.x * drag.x));
    const double thrust_n = std::clamp(along_n + drag.z, 0.0, limits_.max_load_factor * helicopter_weight_n);
    md500::RotorFlow rotor{-body_mps.z, std::hypot(body_mps.x, body_mps.y), 0.0};
    for (int i = 0; i < 200; ++i) {
        rotor.induced_mps += 0.5 * (md500::steady_induced_mps(thrust_n, rotor, air_) - rotor.induced_mps);
    }
    induced_mps_ = rotor.induced_mps;
    collective_ = std::clamp(md500::collective_for_thrust(thrust_n, rotor, air_), 0.0, 1.0);
}

HelicopterFlight::Flow HelicopterFlight::flow(const glm::dvec3& velocity_mps, const glm::dquat& attitude) const {
    const glm::dvec3 body_mps = glm::conjugate(attitude) * velocity_mps;
    Flow flow;
    flow.rotor = {-body_mps.z, std::hypot(body_mps.x, body_mps.y), induced_mps_};
    const double blades_n = md500::blade_thrust_n(collective_, flow.rotor, air_);
    const double max_n =
        std::min(md500::max_powered_thrust_n(flow.rotor, air_), limits_.max_load_factor * helicopter_weight_n);
    flow.thrust_n = std::clamp(blades_n, 0.0, max_n);
    flow.is_thrust_limited = blades_n > max_n;
    const glm::dvec3 force_n = drag_n(body_mps, air_) + flow.thrust_n * body_up;
    flow.load_factor = std::hypot(force_n.x, force_n.z) / helicopter_weight_n;
    flow.acceleration_mps2 = attitude * force_n / md500::mass_kg + glm::dvec3(0.0, 0.0, -gravity_mps2);
    return flow;
}

double HelicopterFlight::commanded_pitch_rad(const PilotControls& controls, double heading_rad) {
    const glm::dvec3& velocity = state_.velocity_mps;
    const double forward_mps = glm::dot(velocity, direction_from_heading(heading_rad));
    const double centred_rad =
        helicopter_trim(forward_mps, air_).pitch_rad * smooth_step(still_mps, moving_mps, std::abs(forward_mps));
    // Near the never-exceed speed the nose goes down less and less, above it up.
    const double speed_mps = glm::length(velocity);
    const double left = (limits_.max_speed_mps - speed_mps) / speed_margin_mps;
    const double range_rad = controls.pitch < 0.0 ? pitch_range_rad * std::clamp(left, 0.0, 1.0) : pitch_range_rad;
    const double above_mps = std::max(0.0, speed_mps - limits_.max_speed_mps);
    warnings_.is_at_limit = above_mps > 0.0 || (controls.pitch < 0.0 && left < 1.0);
    const double pull_up_rad = forward_mps > 0.0 ? std::min(max_pull_up_rad, pull_up_rad_per_mps * above_mps) : 0.0;
    return std::clamp(centred_rad + controls.pitch * range_rad + pull_up_rad, -steepest_pitch_rad, steepest_pitch_rad);
}

double HelicopterFlight::commanded_yaw_radps(const PilotControls& controls, double heading_rad) const {
    const glm::dvec3& velocity = state_.velocity_mps;
    const glm::dvec3& acceleration = flow_.acceleration_mps2;
    const double level2 = velocity.x * velocity.x + velocity.y * velocity.y;
    const double share = smooth_step(slow_mps, fast_mps, std::sqrt(level2));
    if (share == 0.0) { return controls.yaw * pedal_yaw_radps; }
    const double course_radps = (velocity.y * acceleration.x - velocity.x * acceleration.y) / level2;
    const double error_rad = wrapped_to_pi(sideslip_rad(velocity, heading_rad) + controls.yaw * pedal_sideslip_rad);
    const double coordinated_radps = course_radps + error_rad / sideslip_lag_s;
    return controls.yaw * pedal_yaw_radps * (1.0 - share) + coordinated_radps * share;
}

/// Rate of the attitude in world axes that brings it towards what is asked for.
glm::dvec3 HelicopterFlight::turn_radps(const PilotControls& controls) {
    const EulerAngles angles = euler_from_body_to_world(state_.body_to_world);
    const double pitch_error_rad = commanded_pitch_rad(controls, angles.heading_rad) - angles.pitch_rad;
    const double roll_error_rad = wrapped_to_pi(controls.roll * limits_.bank_rad - angles.roll_rad);
    EulerAngles& rates = angle_rates_radps_;
    const auto towards = [](double rate, double error_rad, double fastest_radps) {
        return first_order_lag(
            rate, std::clamp(error_rad / helicopter_attitude_lag_s, -fastest_radps, fastest_radps), rate_lag_s);
    };
    rates.pitch_rad = towards(rates.pitch_rad, pitch_error_rad, max_helicopter_pitch_radps);
    rates.roll_rad = towards(rates.roll_rad, roll_error_rad, limits_.roll_rate_radps);
    rates.heading_rad = first_order_lag(rates.heading_rad,
        std::clamp(commanded_yaw_radps(controls, angles.heading_rad), -fastest_yaw_radps, fastest_yaw_radps),
        rate_lag_s);
    warnings_.is_at_limit = warnings_.is_at_limit || std::abs(angles.roll_rad) > 0.99 * limits_.bank_rad ||
                            std::abs(rates.roll_rad) > 0.99 * limits_.roll_rate_radps;
    // Heading about the world's down, pitch about the level right, roll about the nose.
    const glm::dvec3 ahead = direction_from_heading(angles.heading_rad);
    const glm::dvec3 right(ahead.y, -ahead.x, 0.0);
    const glm::dvec3 nose = state_.body_to_world * glm::dvec3(1.0, 0.0, 0.0);
    return rates.heading_rad * glm::dvec3(0.0, 0.0, -1.0) + rates.pitch_rad * right + rates.roll_rad * nose;
}

void HelicopterFlight::move(const glm::dvec3& turn_radps) {
    const double half_s = 0.5 * step_s;
    const glm::dvec3 velocity = state_.velocity_mps;
    const Flow half =
        flow(velocity + half_s * flow_.acceleration_mps2, turned(state_.body_to_world, turn_radps, half_s));
    state_.velocity_mps = velocity + step_s * half.acceleration_mps2;
    state_.position_m += half_s * (velocity + state_.velocity_mps);
    state_.body_to_world = turned(state_.body_to_world, turn_radps, step_s);
}

void HelicopterFlight::step(const PilotControls& controls) {
    const PilotControls asked = clean(controls);
    move(turn_radps(asked));
    collective_ = first_order_lag(collective_, asked.throttle, collective_lag_s);
    induced_mps_ =
        first_order_lag(induced_mps_, md500::steady_induced_mps(flow_.thrust_n, flow_.rotor, air_), downwash_lag_s);
    air_ = standard_air(state_.position_m.z);
    flow_ = flow(state_.velocity_mps, state_.body_to_world);
    warnings_.is_at_limit = warnings_.is_at_limit || flow_.is_thrust_limited;
    state_.load_factor = flow_.load_factor;
    state_.time_s = clock_.next_s();
}

} // namespace octant::sim
