#pragma once

namespace octant::sim {

/// What an aircraft can fly. A path that asks for more is refused (or clipped when asked to).
struct AircraftLimits {
    /// The limits of lift over weight, in g.
    double min_load_factor = 0.0;
    double max_load_factor = 0.0;
    /// The fastest change of the load factor (g onset), g/s.
    double load_factor_rate_gps = 0.0;
    /// The fastest roll.
    double roll_rate_radps = 0.0;
    /// The steepest bank; pi = no limit.
    double bank_rad = 0.0;
    double min_speed_mps = 0.0;
    double max_speed_mps = 0.0;
    /// The steepest climb that can be sustained.
    double climb_rate_mps = 0.0;
    /// The fastest change of speed along the path, up or down.
    double acceleration_mps2 = 0.0;
};

} // namespace octant::sim
