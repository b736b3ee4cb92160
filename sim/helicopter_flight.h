#pragma once

#include "sim/aircraft_state.h"
#include "sim/atmosphere.h"
#include "sim/base/axes.h"
#include "sim/flight_steps.h"
#include "sim/piloted_flight.h"

namespace octant::sim::md500 {

inline constexpr double mass_kg = 1361.0;

/// The airflow at the rotor.
struct RotorFlow {
    /// The speed of climb along the shaft.
    double axial_mps = 0.0;
    /// The speed in the plane of the disc; not negative.
    double in_plane_mps = 0.0;
    /// The induced velocity (downwash) at the disc.
    double induced_mps = 0.0;
};

/// What the blades lift at a collective of 0 .. 1 with no regard to power. May be negative.
double blade_thrust_n(double collective, const RotorFlow& flow, const Air& air);

/// Collective that lifts this; may lie outside 0 .. 1.
double collective_for_thrust(double newtons, const RotorFlow& flow, const Air& air);

/// The most that the engine's power can lift, infinite where the wind drives the rotor.
double max_powered_thrust_n(const RotorFlow& flow, const Air& air);

/// The induced velocity of a steady thrust.
double steady_induced_mps(double newtons, const RotorFlow& flow, const Air& air);

} // namespace octant::sim::md500

namespace octant::sim {

/// The 500MD by hand. The cyclic asks for pitch and bank, centred for wings level and the pitch that holds the speed
/// (below a walking pace, that stops it); the throttle is the collective. The pedals turn on the spot when slow and ask
/// for sideslip in forward flight.
class HelicopterFlight final : public PilotedFlight {
public:
    HelicopterFlight(const AircraftLimits& limits, const AircraftState& start);

    void step(const PilotControls& controls) override;

    const AircraftState& state() const override { return state_; }

    FlightWarnings warnings() const override { return warnings_; }

    double trim_throttle() const override { return trim_collective_; }

private:
    struct Flow {
        md500::RotorFlow rotor;
        double thrust_n = 0.0;
        /// Whether the blades could lift more than power or strength allow.
        bool is_thrust_limited = false;
        glm::dvec3 acceleration_mps2{0.0};
        double load_factor = 0.0;
    };

    Flow flow(const glm::dvec3& velocity_mps, const glm::dquat& attitude) const;
    glm::dvec3 turn_radps(const PilotControls& controls);
    double commanded_pitch_rad(const PilotControls& controls, double heading_rad);
    double commanded_yaw_radps(const PilotControls& controls, double heading_rad) const;
    void move(const glm::dvec3& turn_radps);
    void update_downwash();

    AircraftLimits limits_;
    AircraftState state_;
    StepClock clock_;
    Air air_;
    double trim_collective_ = 0.0;
    /// What the blades stand at; lags behind the pilot's lever.
    double collective_ = 0.0;
    double induced_mps_ = 0.0;
    /// The rates of heading, pitch and roll.
    EulerAngles angle_rates_radps_;
    FlightWarnings warnings_;
    Flow flow_;
};

/// See trimmed_state in flight_models.h.
AircraftState trimmed_helicopter(const glm::dvec3& position_m, double heading_rad, double speed_mps);

} // namespace octant::sim
