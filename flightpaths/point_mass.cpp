// Equations of motion of a point mass in coordinated flight: any text on flight mechanics, e.g. Miele, Flight Mechanics
// I (1962), ch. 4, "flight in a moving vertical plane", here without thrust and drag (their sum is the commanded change
// of speed). Deviations: flight axes as a quaternion in place of path angle, track and bank.

#include "flightpaths/point_mass.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <cmath>

namespace octant::flightpaths {

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

} // namespace octant::flightpaths
