#pragma once

#include "sim/piloted_flight.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace octant::sim {

/// The simulation advances in steps of 1/120 s whatever the picture rate: a whole number of them fits between path
/// samples (20 Hz) and between frames at 60 or 20 Hz. Counting steps instead of adding up times keeps every time exact
/// and runs repeatable.
inline constexpr int steps_per_second = 120;
inline constexpr double step_s = 1.0 / steps_per_second;

constexpr double time_of_step(long step) { return static_cast<double>(step) / steps_per_second; }

/// The last step at or before a time; a time within 1e-6 of a step below it counts as that step. For times within 1e7 s
/// of zero, which the readers of paths see to: far beyond, a step number does not fit its type.
constexpr long step_at(double time_s) {
    const double steps = time_s * steps_per_second + 1e-6 * steps_per_second;
    const long whole = static_cast<long>(steps);
    return static_cast<double>(whole) > steps ? whole - 1 : whole;
}

/// The controls clamped to their ranges; a not-a-number becomes 0.
PilotControls clean(const PilotControls& controls);

/// The value after one step of a first-order lag towards `target`.
double first_order_lag(double now, double target, double time_constant_s);

/// The same with a rate of at most `fastest_per_s` in either direction.
double first_order_lag(double now, double target, double time_constant_s, double fastest_per_s);

/// 0 up to `low`, 1 from `high` on, smooth between. low < high.
double smooth_step(double low, double high, double value);

/// Attitude after turning for `time_s` at a rate given in world axes. Unit again.
glm::dquat turned(const glm::dquat& attitude, const glm::dvec3& world_radps, double time_s);

/// Level and unaccelerated at a place, the nose that far above the horizon.
AircraftState level_state(const glm::dvec3& position_m, double heading_rad, double pitch_rad, double speed_mps);

/// Times of the steps after a start: start plus steps, and where the start is the time of a step, exactly time_of_step.
class StepClock {
public:
    explicit StepClock(double start_s);

    double next_s();

private:
    double start_s_ = 0.0;
    long first_step_ = 0;
    long steps_ = 0;
};

} // namespace octant::sim
