#include "sim/flight_steps.h"

#include "sim/base/axes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::sim {

namespace {

double within(double value, double low, double high) { return std::isnan(value) ? 0.0 : std::clamp(value, low, high); }

double share_of_step(double time_constant_s) { return -std::expm1(-step_s / time_constant_s); }

} // namespace

PilotControls clean(const PilotControls& controls) {
    return {within(controls.pitch, -1.0, 1.0), within(controls.roll, -1.0, 1.0), within(controls.yaw, -1.0, 1.0),
        within(controls.throttle, 0.0, 1.0)};
}

double first_order_lag(double now, double target, double time_constant_s) {
    return now + (target - now) * share_of_step(time_constant_s);
}

double first_order_lag(double now, double target, double time_constant_s, double fastest_per_s) {
    const double most = fastest_per_s * step_s;
    return now + std::clamp((target - now) * share_of_step(time_constant_s), -most, most);
}

double smooth_step(double low, double high, double value) {
    const double u = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

glm::dquat turned(const glm::dquat& attitude, const glm::dvec3& world_radps, double time_s) {
    const double rate_radps = glm::length(world_radps);
    const double half_rad = 0.5 * rate_radps * time_s;
    if (!(half_rad > 0.0)) { return attitude; }
    const glm::dvec3 axis = world_radps * (std::sin(half_rad) / rate_radps);
    return glm::normalize(glm::dquat(std::cos(half_rad), axis.x, axis.y, axis.z) * attitude);
}

AircraftState level_state(const glm::dvec3& position_m, double heading_rad, double pitch_rad, double speed_mps) {
    AircraftState state;
    state.position_m = position_m;
    state.velocity_mps = speed_mps * direction_from_heading(heading_rad);
    state.body_to_world = body_to_world_from_euler({heading_rad, pitch_rad, 0.0});
    return state;
}

StepClock::StepClock(double start_s) : start_s_(start_s) {
    const long step = std::abs(start_s) < 1e7 ? step_at(start_s) : 0;
    if (time_of_step(step) == start_s) {
        first_step_ = step;
        start_s_ = 0.0;
    }
}

double StepClock::next_s() {
    ++steps_;
    return start_s_ + time_of_step(first_step_ + steps_);
}

} // namespace octant::sim
