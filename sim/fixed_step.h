#pragma once

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

} // namespace octant::sim
