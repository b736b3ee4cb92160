#pragma once

#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/flight_models.h"
#include "sim/flight_steps.h"
#include "sim/piloted_flight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstddef>
#include <cstring>
#include <memory>
#include <random>

namespace octant::tests {

inline long steps_of(double seconds) { return std::lround(seconds * sim::steps_per_second); }

/// Flies on with the controls that `pilot(seconds since the call)` gives; `look` sees every step.
template <class Pilot, class Look>
void fly(sim::PilotedFlight& flight, double seconds, Pilot&& pilot, const Look& look) {
    for (long step = 0; step < steps_of(seconds); ++step) {
        flight.step(pilot(sim::time_of_step(step)));
        look(flight);
    }
}

/// Flies on with the same controls.
inline void hold(sim::PilotedFlight& flight, double seconds, const sim::PilotControls& controls) {
    fly(
        flight, seconds, [&](double) { return controls; }, [](const sim::PilotedFlight&) {});
}

/// An F-15 in level flight towards 70 degrees, ready to be flown.
inline std::unique_ptr<sim::PilotedFlight> trimmed_f15(double speed_mps, double height_m = 1000.0) {
    const sim::AircraftKind& kind = sim::aircraft_kind("f15");
    return sim::make_piloted_flight(kind, sim::trimmed_state(kind, {0, 0, height_m}, rad_from_deg(70), speed_mps));
}

inline double speed_mps(const sim::PilotedFlight& flight) { return glm::length(flight.state().velocity_mps); }

/// Height that the aircraft's energy is worth.
inline double energy_height_m(const sim::PilotedFlight& flight) {
    const sim::AircraftState& state = flight.state();
    return state.position_m.z + 0.5 * glm::dot(state.velocity_mps, state.velocity_mps) / gravity_mps2;
}

inline EulerAngles angles_of(const sim::PilotedFlight& flight) {
    return euler_from_body_to_world(flight.state().body_to_world);
}

/// Rate of turning between two attitudes a step apart.
inline double turn_radps(const glm::dquat& before, const glm::dquat& after) {
    const glm::dquat between = glm::conjugate(before) * after;
    const double sine = std::hypot(between.x, between.y, between.z);
    return 2.0 * std::atan2(sine, std::abs(between.w)) * sim::steps_per_second;
}

inline bool is_finite(const sim::AircraftState& state) {
    double sum = state.time_s + state.load_factor;
    for (int i = 0; i < 3; ++i) { sum += state.position_m[i] + state.velocity_mps[i]; }
    return std::isfinite(sum) && std::abs(glm::length(state.body_to_world) - 1.0) < 1e-12;
}

inline bool same_bits(const sim::AircraftState& a, const sim::AircraftState& b) {
    return std::memcmp(&a, &b, offsetof(sim::AircraftState, is_present)) == 0;
}

/// A pilot who moves each control to a new place about once a second, often to a stop.
class WildPilot {
public:
    explicit WildPilot(std::uint32_t seed) : random_(seed) {}

    sim::PilotControls operator()(double) {
        if (random_() % 120 < 4) {
            double* const all[] = {&controls_.pitch, &controls_.roll, &controls_.yaw, &controls_.throttle};
            *all[random_() % 4] = 1e-3 * (static_cast<double>(random_() % 4001) - 2000.0);
        }
        return controls_;
    }

private:
    std::mt19937 random_;
    sim::PilotControls controls_;
};

/// The most that the energy height rises in one step of a wild flight without throttle.
inline double largest_rise_without_throttle_m(sim::PilotedFlight& flight, std::uint32_t seed, double seconds) {
    WildPilot wild(seed);
    double before_m = energy_height_m(flight);
    double rise_m = 0.0;
    fly(
        flight, seconds,
        [&](double t) {
            sim::PilotControls controls = wild(t);
            controls.throttle = 0.0;
            return controls;
        },
        [&](const sim::PilotedFlight& f) {
            rise_m = std::max(rise_m, energy_height_m(f) - before_m);
            before_m = energy_height_m(f);
        });
    return rise_m;
}

} // namespace octant::tests
