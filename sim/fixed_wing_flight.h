#pragma once

#include "sim/aircraft_state.h"
#include "sim/atmosphere.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"
#include "sim/piloted_flight.h"

namespace octant::sim::f15 {

inline constexpr double mass_kg = 17000.0;
inline constexpr double wing_m2 = 56.5;

/// Lift rises with this slope, per radian, to linear_alpha_rad, ever less to the stall, and breaks.
inline constexpr double lift_slope = 4.0;
inline constexpr double linear_alpha_rad = rad_from_deg(12.0);
inline constexpr double stall_alpha_rad = rad_from_deg(28.0);
inline constexpr double max_lift_coefficient = 0.5 * lift_slope * (linear_alpha_rad + stall_alpha_rad);

/// Lift over dynamic pressure and wing area, for any angle of attack in (-pi, pi]: positive to the side of the canopy.
double lift_coefficient(double alpha_rad);

/// Angle of attack below the stall that gives this lift. |lift| <= max_lift_coefficient.
double alpha_for_lift(double coefficient);

double drag_coefficient(double alpha_rad, double beta_rad, double mach);

/// To the right; sideslip is positive when the wind comes from the right.
double side_coefficient(double beta_rad);

/// Thrust of both engines along the body's x axis. Lever 0 idle, 0.8 full dry, 1 full reheat.
double thrust_n(double lever, double mach, const Air& air);

/// Lever that gives this thrust, the nearest where none does.
double lever_for_thrust(double newtons, double mach, const Air& air);

/// The share of the reheat that a lever asks for, 0 .. 1.
double reheat_from_lever(double lever);

} // namespace octant::sim::f15

namespace octant::sim {

/// The F-15 by hand. The stick asks for load factor and roll rate, as a control augmentation system has it: centred it
/// keeps the climb angle (cos of it, in g), so that in a bank the pilot pulls. After a stall it is stable in pitch
/// until the pilot pulls or pushes: centred, it lets the nose down to gather speed and brings it up to level flight at
/// that speed. The rudder asks for sideslip.
class FixedWingFlight final : public PilotedFlight {
public:
    FixedWingFlight(const AircraftLimits& limits, const AircraftState& start);

    void step(const PilotControls& controls) override;

    const AircraftState& state() const override { return state_; }

    FlightWarnings warnings() const override { return warnings_; }

    double trim_throttle() const override { return trim_throttle_; }

private:
    /// Airflow and forces at one velocity and attitude.
    struct Flow {
        double speed_mps = 0.0;
        /// The angle of attack as velocity and attitude have it, without incidence_rad_.
        double alpha_rad = 0.0;
        double beta_rad = 0.0;
        /// A unit vector along the velocity; 0 at rest.
        glm::dvec3 along{0.0};
        glm::dvec3 acceleration_mps2{0.0};
        /// The component of the thrust along the lift.
        double thrust_lift_n = 0.0;
        double load_factor = 0.0;
    };

    /// The angle of attack at the beginning and at the end of a step.
    struct PitchStep {
        double from_rad = 0.0;
        double to_rad = 0.0;
        double incidence_from_rad = 0.0;
        double incidence_to_rad = 0.0;
    };

    Flow flow(const glm::dvec3& velocity_mps, const glm::dquat& attitude, double incidence_rad) const;
    glm::dvec3 turn_radps(const Flow& flow, const glm::dquat& attitude, const PitchStep& pitching, double share) const;
    void set_commands(const PilotControls& controls);
    double max_load_factor() const;
    bool is_safe(double climb_rad) const;
    double recovery_load_factor(double climb_rad, double centred) const;
    double alpha_for_load_factor(double load_factor, double speed_mps, double pull);
    void move(const PitchStep& pitching);

    AircraftLimits limits_;
    AircraftState state_;
    StepClock clock_;
    Air air_;
    Flow flow_;
    FlightWarnings warnings_;
    /// Whether it has stalled and is not yet back in level flight.
    bool is_recovering_stall_ = false;
    double trim_throttle_ = 0.0;
    /// What the engines run at; lags behind the pilot's lever.
    double lever_ = 0.0;
    /// Lags behind what the stick commands.
    double commanded_load_factor_ = 1.0;
    /// Gives commanded_load_factor_; includes incidence_rad_.
    double commanded_alpha_rad_ = 0.0;
    /// The roll rate about the velocity.
    double roll_radps_ = 0.0;
    double commanded_sideslip_rad_ = 0.0;
    /// What the start's attitude lacks of the angle of attack of its load factor; fades away.
    double incidence_rad_ = 0.0;
};

/// See trimmed_state in flight_models.h.
AircraftState trimmed_fixed_wing(const glm::dvec3& position_m, double heading_rad, double speed_mps);

} // namespace octant::sim
