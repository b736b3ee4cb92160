// Sources, all public:
// - Wing 56.5 m2 (608 ft2), aspect ratio 3, leading edge swept 45 degrees; empty 12,700 kg: data
//   sheets of the F-15C. 17,000 kg is that with a pilot, missiles and about half the inside fuel.
// - Slope of the lift: Helmbold's formula for swept wings gives 3.1 per radian for the bare wing;
//   4.0 allows for the broad body. Drag of a plate across the wind: Hoerner, Fluid-Dynamic Drag.
// - Thrust with height and Mach number: Mattingly, Heiser and Pratt, Aircraft Engine Design, 2nd
//   ed., ch. 2, low-bypass mixed turbofan, for the 23,770 lb of the F100-PW-220 with reheat.
// - Dry thrust over thrust with reheat: the tables of an engine of that family in Nguyen et al.,
//   NASA TP-1538 (1979), printed in Stevens and Lewis, Aircraft Control and Simulation, app. A.
//   From sea level to 20,000 ft it falls from 0.57 .. 0.63 at rest to 0.47 .. 0.49 at Mach 0.8.
// Deviations: angle and size of the most lift, zero-lift and wave drag are chosen so that a stall at about 115 kt, the
// published 800 kt (M 1.2) low down, the climb of the 50,000 ft/min class and M 2 at height come out roughly. Lift does
// not depend on the Mach number. Idle gives no net thrust.

#include "sim/fixed_wing_aero.h"

#include "sim/flight_steps.h"

#include <algorithm>
#include <cmath>

namespace octant::sim::f15 {

namespace {

constexpr double broken_rad = rad_from_deg(36.0);
constexpr double bend_rad = stall_alpha_rad - linear_alpha_rad;
constexpr double plate_drag = 1.9;
constexpr double side_slope = 0.9; // side force per radian of sideslip
constexpr double induced_factor = 0.13;

constexpr double dry_lever = 0.8;
constexpr double installed_share = 0.92;
constexpr double throttle_ratio = 1.07;
constexpr double static_thrust_n = 2.0 * 23770.0 * 4.4482216 * installed_share;

double zero_lift_drag(double mach) {
    return 0.0215 + 0.0185 * smooth_step(0.85, 1.15, mach) - 0.012 * smooth_step(1.15, 2.2, mach);
}

/// Dry thrust over thrust with reheat.
double dry_share(double mach) { return std::clamp(0.62 - 0.18 * mach, 0.35, 0.62); }

double full_thrust_n(double mach, const Air& air) {
    const double ram = 1.0 + 0.2 * mach * mach;
    const double total_pressure = air.pressure_ratio * std::pow(ram, 3.5);
    const double total_temperature = air.temperature_ratio * ram;
    const double hot = std::max(0.0, total_temperature - throttle_ratio);
    return static_thrust_n * total_pressure * std::max(0.0, 1.0 - 3.5 * hot / total_temperature);
}

} // namespace

double lift_coefficient(double alpha_rad) {
    const double size_rad = std::abs(alpha_rad);
    double lift = lift_slope * size_rad;
    if (size_rad > linear_alpha_rad) {
        const double to_peak = stall_alpha_rad - std::min(size_rad, stall_alpha_rad);
        lift = max_lift_coefficient - 0.5 * lift_slope / bend_rad * to_peak * to_peak;
    }
    if (size_rad > stall_alpha_rad) {
        const double plate = plate_drag * std::sin(size_rad) * std::abs(std::cos(size_rad));
        lift += smooth_step(stall_alpha_rad, broken_rad, size_rad) * (plate - lift);
    }
    return std::copysign(lift, alpha_rad);
}

double alpha_for_lift(double coefficient) {
    const double size = std::min(std::abs(coefficient), max_lift_coefficient);
    const double alpha_rad =
        size <= lift_slope * linear_alpha_rad
            ? size / lift_slope
            : stall_alpha_rad - std::sqrt((max_lift_coefficient - size) * 2.0 * bend_rad / lift_slope);
    return std::copysign(alpha_rad, coefficient);
}

double drag_coefficient(double alpha_rad, double beta_rad, double mach) {
    const double lift = lift_coefficient(alpha_rad);
    const double attached = induced_factor * lift * lift;
    const double across = std::sin(alpha_rad);
    const double plate = 0.12 + plate_drag * across * across;
    const double broken = smooth_step(linear_alpha_rad, stall_alpha_rad, std::abs(alpha_rad));
    const double aside = std::sin(beta_rad);
    return zero_lift_drag(mach) + attached + broken * (plate - attached) + aside * aside;
}

double side_coefficient(double beta_rad) { return -side_slope * std::sin(beta_rad) * std::cos(beta_rad); }

double thrust_n(double lever, double mach, const Air& air) {
    const double dry = dry_share(mach);
    const double share =
        lever <= dry_lever ? dry * lever / dry_lever : dry + (1.0 - dry) * (lever - dry_lever) / (1.0 - dry_lever);
    return share * full_thrust_n(mach, air);
}

double lever_for_thrust(double newtons, double mach, const Air& air) {
    const double full_n = full_thrust_n(mach, air);
    const double dry = dry_share(mach);
    const double share = full_n > 0.0 ? std::clamp(newtons / full_n, 0.0, 1.0) : 1.0;
    return share <= dry ? share / dry * dry_lever : dry_lever + (share - dry) / (1.0 - dry) * (1.0 - dry_lever);
}

double reheat_from_lever(double lever) { return std::clamp((lever - dry_lever) / (1.0 - dry_lever), 0.0, 1.0); }

} // namespace octant::sim::f15
