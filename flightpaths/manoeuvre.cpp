// How each leg is flown. The rules are our own: a bank and a load factor to aim at, both followed with a short lag and
// within the aircraft's rates.
#include "flightpaths/manoeuvre.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <algorithm>
#include <cmath>

namespace octant::flightpaths {

// Equations of motion of a point mass in coordinated flight: any text on flight mechanics, e.g. Miele, Flight Mechanics
// I (1962), ch. 4, "flight in a moving vertical plane", here without thrust and drag (their sum is the commanded change
// of speed). Deviations: flight axes as a quaternion in place of path angle, track and bank.

namespace {

struct Rate {
    glm::dvec3 position_mps{0.0};
    double speed_mps2 = 0.0;
    glm::dquat rotation{0.0, 0.0, 0.0, 0.0};
    double load_factor_gps = 0.0;
};

Rate rate_of(const PointMass& mass, const PointMassControls& controls) {
    // Gravity in flight axes; what of it is not along the velocity bends the path.
    const glm::dvec3 gravity = glm::conjugate(mass.flight_to_world) * glm::dvec3(0.0, 0.0, -gravity_mps2);
    const double pitch_rate_radps = (mass.load_factor * gravity_mps2 - gravity.z) / mass.speed_mps;
    const double yaw_rate_radps = gravity.y / mass.speed_mps;
    const glm::dquat turn(0.0, controls.roll_rate_radps, pitch_rate_radps, yaw_rate_radps);
    return {velocity_mps(mass), controls.acceleration_mps2, 0.5 * (mass.flight_to_world * turn),
        controls.load_factor_rate_gps};
}

PointMass moved(const PointMass& from, const Rate& rate, double step_s) {
    PointMass to;
    to.position_m = from.position_m + step_s * rate.position_mps;
    to.speed_mps = from.speed_mps + step_s * rate.speed_mps2;
    to.flight_to_world = glm::normalize(from.flight_to_world + step_s * rate.rotation);
    to.load_factor = from.load_factor + step_s * rate.load_factor_gps;
    return to;
}

Rate weighted(const Rate& a, const Rate& b, const Rate& c, const Rate& d) {
    const auto mean = [](const auto& w, const auto& x, const auto& y, const auto& z) {
        return (w + 2.0 * x + 2.0 * y + z) * (1.0 / 6.0);
    };
    return {mean(a.position_mps, b.position_mps, c.position_mps, d.position_mps),
        mean(a.speed_mps2, b.speed_mps2, c.speed_mps2, d.speed_mps2),
        mean(a.rotation, b.rotation, c.rotation, d.rotation),
        mean(a.load_factor_gps, b.load_factor_gps, c.load_factor_gps, d.load_factor_gps)};
}

} // namespace

PointMass point_mass_at(
    const glm::dvec3& position_m, double speed_mps, double track_rad, double climb_rad, double bank_rad) {
    return {position_m, speed_mps, body_to_world_from_euler({track_rad, climb_rad, bank_rad}), 1.0};
}

PointMass stepped(const PointMass& now, const PointMassControls& controls, double step_s) {
    const Rate a = rate_of(now, controls);
    const Rate b = rate_of(moved(now, a, 0.5 * step_s), controls);
    const Rate c = rate_of(moved(now, b, 0.5 * step_s), controls);
    const Rate d = rate_of(moved(now, c, step_s), controls);
    return moved(now, weighted(a, b, c, d), step_s);
}

glm::dvec3 velocity_mps(const PointMass& mass) {
    return mass.speed_mps * (mass.flight_to_world * glm::dvec3(1.0, 0.0, 0.0));
}

double track_rate_radps(const PointMass& mass) {
    const glm::dvec3 velocity = velocity_mps(mass);
    const glm::dvec3 lift = mass.flight_to_world * glm::dvec3(0.0, 0.0, -1.0);
    const glm::dvec3 sideways = mass.load_factor * gravity_mps2 * lift;
    const double level2 = velocity.x * velocity.x + velocity.y * velocity.y;
    return level2 > 0.0 ? (velocity.y * sideways.x - velocity.x * sideways.y) / level2 : 0.0;
}

glm::dquat body_to_world(const PointMass& mass, double angle_of_attack_rad) {
    return mass.flight_to_world * glm::angleAxis(angle_of_attack_rad, glm::dvec3(0.0, 1.0, 0.0));
}

namespace {

constexpr double bank_lag_s = 0.25;
constexpr double load_factor_lag_s = 0.15;
constexpr double path_lag_s = 1.0;
/// Most of a load factor spent on correcting the path angle, g.
constexpr double path_correction_g = 0.5;

double weave_g(double amplitude_g, double period_s, double since_s) {
    const double growth = std::min(1.0, since_s / period_s);
    return amplitude_g * growth * std::sin(2.0 * pi * since_s / period_s);
}

ManoeuvreTarget aim_of_pull(double right_g, double up_g) {
    return {std::atan2(right_g, up_g), 0.0, std::hypot(right_g, up_g), 0.0};
}

} // namespace

ManoeuvreTarget weave_target(const Leg& leg, double since_s, double climb_rad) {
    const auto at = [&](double time_s) {
        return aim_of_pull(weave_g(leg.lateral_g, leg.period_s, time_s),
            std::cos(climb_rad) + weave_g(leg.vertical_g, leg.vertical_period_s, time_s));
    };
    constexpr double ahead_s = 0.01;
    const ManoeuvreTarget next = at(since_s + ahead_s);
    ManoeuvreTarget aim = at(since_s);
    aim.bank_rate_radps = wrapped_to_pi(next.bank_rad - aim.bank_rad) / ahead_s;
    aim.load_factor_rate_gps = (next.load_factor - aim.load_factor) / ahead_s;
    return aim;
}

LegPilot::LegPilot(const Leg& leg, const PointMass& start, const sim::AircraftLimits& limits)
    : leg_(leg), limits_(limits), start_height_m_(start.position_m.z) {
    const EulerAngles angles = euler_from_body_to_world(start.flight_to_world);
    start_climb_rad_ = angles.pitch_rad;
    last_track_rad_ = angles.heading_rad;
    // Half of what the aircraft could do is how pilots roll when nothing presses.
    const double share = leg.kind == LegKind::Jink ? 1.0 : 0.5;
    roll_rate_limit_radps_ = leg.roll_rate_radps.value_or(share * limits.roll_rate_radps);
    if (leg.kind == LegKind::Hold) {
        hold_climb_rad_ = angles.pitch_rad + climb_to_come_rad(start);
    } else if (leg.kind != LegKind::Pull && leg.kind != LegKind::Push) {
        hold_climb_rad_ = leg.climb_rad.value_or(0.0);
    }
}

PointMassControls LegPilot::controls(const PointMass& now, double since_s) const {
    const ManoeuvreTarget to = aim(now, since_s);
    PointMassControls controls;
    controls.roll_rate_radps = roll_rate(now, to);
    const double aimed = std::clamp(to.load_factor, limits_.min_load_factor, limits_.max_load_factor);
    controls.load_factor_rate_gps = std::clamp(to.load_factor_rate_gps + (aimed - now.load_factor) / load_factor_lag_s,
        -limits_.load_factor_rate_gps, limits_.load_factor_rate_gps);
    const bool fast_enough =
        leg_.to_speed_mps && (leg_.acceleration_mps2 > 0.0) == (now.speed_mps >= *leg_.to_speed_mps);
    controls.acceleration_mps2 = fast_enough ? 0.0 : leg_.acceleration_mps2;
    return controls;
}

bool LegPilot::done(const PointMass& now, double since_s) const {
    constexpr double rounding_s = 1e-9;
    if (leg_.duration_s) { return since_s >= *leg_.duration_s - rounding_s; }
    if (leg_.to_height_m) {
        return *leg_.to_height_m >= start_height_m_ ? now.position_m.z >= *leg_.to_height_m
                                                    : now.position_m.z <= *leg_.to_height_m;
    }
    return leg_.heading_change_rad ? reached_heading(now) : reached_climb(now);
}

void LegPilot::count_turn(const PointMass& now) {
    const double track = euler_from_body_to_world(now.flight_to_world).heading_rad;
    turned_rad_ += wrapped_to_pi(track - last_track_rad_);
    last_track_rad_ = track;
}

ManoeuvreTarget LegPilot::aim(const PointMass& now, double since_s) const {
    const EulerAngles angles = euler_from_body_to_world(now.flight_to_world);
    if (leg_.kind == LegKind::Jink) { return weave_target(leg_, since_s, angles.pitch_rad); }
    ManoeuvreTarget aim;
    if (leg_.kind == LegKind::Pull || leg_.kind == LegKind::Push) {
        // Loaded only as far as the lift points where it should: the roll into it is unloaded.
        aim.bank_rad = *leg_.bank_rad;
        const double share = std::max(0.0, std::cos(aim.bank_rad - angles.roll_rad));
        aim.load_factor = 1.0 + (*leg_.load_factor - 1.0) * share * share;
        return aim;
    }
    if (leg_.kind == LegKind::Turn) {
        const double bank =
            leg_.bank_rad ? *leg_.bank_rad : std::acos(std::min(1.0, std::cos(hold_climb_rad_) / *leg_.load_factor));
        aim.bank_rad = leg_.to_the_left ? -bank : bank;
    }
    aim.load_factor = load_factor_to_hold_path(now, aim.bank_rad);
    return aim;
}

double LegPilot::load_factor_to_hold_path(const PointMass& now, double aim_bank_rad) const {
    const EulerAngles angles = euler_from_body_to_world(now.flight_to_world);
    const double correction_g = now.speed_mps / gravity_mps2 * (hold_climb_rad_ - angles.pitch_rad) / path_lag_s;
    const double up_g = std::cos(angles.pitch_rad) + std::clamp(correction_g, -path_correction_g, path_correction_g);
    // Beyond about 80 degrees of bank lift does not hold the path: wait for the roll, unloaded.
    const double steepest_rad = std::max(rad_from_deg(80.0), std::abs(aim_bank_rad));
    ManoeuvreTarget rolling;
    rolling.bank_rad = aim_bank_rad;
    const double bank_soon_rad = angles.roll_rad + load_factor_lag_s * roll_rate(now, rolling);
    if (std::abs(bank_soon_rad) > steepest_rad) { return up_g; }
    return up_g / std::cos(bank_soon_rad);
}

double LegPilot::roll_rate(const PointMass& now, const ManoeuvreTarget& aim) const {
    const EulerAngles angles = euler_from_body_to_world(now.flight_to_world);
    // A turn on a climbing path banks the flight axes by itself.
    const double by_turn_radps = track_rate_radps(now) * std::sin(angles.pitch_rad);
    const double wanted_radps =
        aim.bank_rate_radps + wrapped_to_pi(aim.bank_rad - angles.roll_rad) / bank_lag_s - by_turn_radps;
    return std::clamp(wanted_radps, -roll_rate_limit_radps_, roll_rate_limit_radps_);
}

double LegPilot::climb_to_come_rad(const PointMass& now) const {
    const EulerAngles angles = euler_from_body_to_world(now.flight_to_world);
    const double rate_radps =
        gravity_mps2 / now.speed_mps * (now.load_factor * std::cos(angles.roll_rad) - std::cos(angles.pitch_rad));
    const double unloading_s = 0.5 * std::abs(now.load_factor - 1.0) / limits_.load_factor_rate_gps + load_factor_lag_s;
    return rate_radps * unloading_s;
}

bool LegPilot::reached_climb(const PointMass& now) const {
    const double climb_rad = euler_from_body_to_world(now.flight_to_world).pitch_rad;
    const double side = *leg_.climb_rad >= start_climb_rad_ ? 1.0 : -1.0;
    const double to_come_rad = std::max(0.0, side * climb_to_come_rad(now));
    return side * (climb_rad - *leg_.climb_rad) + to_come_rad >= 0.0;
}

bool LegPilot::reached_heading(const PointMass& now) const {
    // A turn rate of g tan(bank) / V while the bank goes down evenly: the turn still to come is the rate now times
    // -ln(cos(bank)) / (tan(bank) * roll rate).
    const double bank_rad =
        std::clamp(std::abs(euler_from_body_to_world(now.flight_to_world).roll_rad), 1e-6, rad_from_deg(85.0));
    const double roll_out_s = -std::log(std::cos(bank_rad)) / (std::tan(bank_rad) * roll_rate_limit_radps_);
    const double side = leg_.to_the_left ? -1.0 : 1.0;
    const double to_come_rad = std::max(0.0, side * track_rate_radps(now)) * roll_out_s;
    return side * turned_rad_ + to_come_rad >= *leg_.heading_change_rad;
}

} // namespace octant::flightpaths
