#pragma once

#include "sim/atmosphere.h"
#include "sim/base/units.h"

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
