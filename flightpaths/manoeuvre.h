#pragma once

#include "flightpaths/path_script.h"
#include "flightpaths/point_mass.h"
#include "sim/aircraft_state.h"

namespace octant::flightpaths {

/// What a pilot aims at in one moment, and how fast the aim moves.
struct ManoeuvreTarget {
    double bank_rad = 0.0;
    double bank_rate_radps = 0.0;
    double load_factor = 1.0;
    double load_factor_rate_gps = 0.0;
};

/// The aim of a weave `since_s` after its start on a path at `climb_rad`. The weave grows evenly over its first period,
/// which keeps it centred on the line it started from.
ManoeuvreTarget weave_target(const Leg& leg, double since_s, double climb_rad);

/// Flies one leg: turns what the leg asks for into controls that the aircraft can follow.
class LegPilot {
public:
    /// The leg must be within the limits (limits_check.h).
    LegPilot(const Leg& leg, const PointMass& start, const sim::AircraftLimits& limits);

    /// Controls for the step that begins now. Roll rate and change of the load factor are within the limits; the change
    /// of speed is what the leg asks for.
    PointMassControls controls(const PointMass& now, double since_s) const;

    /// True when the leg has reached its end. A pull, a push and a turn end a little early: what is still to come while
    /// the aircraft unloads or rolls out is counted in.
    bool done(const PointMass& now, double since_s) const;

    /// To be called after every step, so that turns beyond 180 degrees are counted.
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
