#pragma once

#include "flightpaths/path_script.h"
#include "sim/aircraft_state.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace octant::flightpaths {

/// An aircraft as a point that lift pulls along its own up axis. The flight axes (x along the velocity, y right, z
/// down, away from the lift) are a rotation and not two angles, so that a bank beyond 90 degrees or a climb through the
/// vertical is no special case.
struct PointMass {
    /// World axes.
    glm::dvec3 position_m{0.0};
    /// Above zero.
    double speed_mps = 0.0;
    /// A unit quaternion.
    glm::dquat flight_to_world{1.0, 0.0, 0.0, 0.0};
    /// Lift over weight, in g.
    double load_factor = 1.0;
};

/// Rates that are held constant over one step.
struct PointMassControls {
    /// About the velocity; positive lowers the right wing.
    double roll_rate_radps = 0.0;
    /// The change of the load factor, g/s.
    double load_factor_rate_gps = 0.0;
    /// The change of the speed.
    double acceleration_mps2 = 0.0;
};

/// Position, track (clockwise from north), path angle (up) and bank (right) as a point mass.
PointMass point_mass_at(
    const glm::dvec3& position_m, double speed_mps, double track_rad, double climb_rad, double bank_rad = 0.0);

/// The point mass `step_s` later. Classical Runge-Kutta of fourth order; the aircraft never sideslips, so its side is
/// turned into the path by what gravity pulls sideways.
PointMass stepped(const PointMass& now, const PointMassControls& controls, double step_s);

glm::dvec3 velocity_mps(const PointMass& mass);

/// Turn rate of the track, rad/s, clockwise. Meaningless within a few degrees of the vertical.
double track_rate_radps(const PointMass& mass);

/// Attitude of the body: the flight axes with the nose raised by the angle of attack.
glm::dquat body_to_world(const PointMass& mass, double angle_of_attack_rad);

/// The load factor, bank and so on that a leg aims at, and how fast the aim moves.
struct ManoeuvreTarget {
    double bank_rad = 0.0;
    double bank_rate_radps = 0.0;
    double load_factor = 1.0;
    double load_factor_rate_gps = 0.0;
};

/// The aim of a weave `since_s` after its start on a path at `climb_rad`. The weave grows evenly over its first period,
/// which keeps it centred on the line it started from.
ManoeuvreTarget weave_target(const Leg& leg, double since_s, double climb_rad);

/// Flies one leg: turns the leg into controls that the aircraft can follow.
class LegPilot {
public:
    /// The leg must be within the limits (limits_check.h).
    LegPilot(const Leg& leg, const PointMass& start, const sim::AircraftLimits& limits);

    /// Controls for the next step. Roll rate and change of the load factor are within the limits; the change of speed
    /// is that of the leg.
    PointMassControls controls(const PointMass& now, double since_s) const;

    /// True at the end of the leg. A pull, a push and a turn end a little earlier, because the aircraft still turns
    /// while it unloads or rolls out.
    bool done(const PointMass& now, double since_s) const;

    /// Must be called after every step, so that turns beyond 180 degrees are counted.
    void count_turn(const PointMass& now);

private:
    ManoeuvreTarget aim(const PointMass& now, double since_s) const;
    double load_factor_to_hold_path(const PointMass& now, double aim_bank_rad) const;
    double roll_rate(const PointMass& now, const ManoeuvreTarget& aim) const;
    /// Change of the path angle while the load factor goes to 1 g.
    double climb_to_come_rad(const PointMass& now) const;
    bool reached_climb(const PointMass& now) const;
    bool reached_heading(const PointMass& now) const;

    Leg leg_;
    sim::AircraftLimits limits_;
    double roll_rate_limit_radps_;
    double hold_climb_rad_ = 0.0;
    double start_height_m_;
    double start_climb_rad_;
    double last_track_rad_;
    double turned_rad_ = 0.0;
};

} // namespace octant::flightpaths
