#pragma once

#include "sim/atmosphere.h"

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
