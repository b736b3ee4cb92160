#pragma once

namespace octant::sim {

/// What an aircraft can fly. A path that asks for more is refused (or clipped when asked to).
struct AircraftLimits {
    double least_load_factor = 0.0;    ///< lift over weight, in g
    double most_load_factor = 0.0;     ///< lift over weight, in g
    double load_factor_rate_gps = 0.0; ///< fastest change of the load factor (g onset), g/s
    double roll_rate_radps = 0.0;      ///< fastest roll
    double bank_rad = 0.0;             ///< steepest bank; pi = no limit
    double least_speed_mps = 0.0;
    double most_speed_mps = 0.0;
    double climb_rate_mps = 0.0;    ///< steepest climb that can be sustained
    double acceleration_mps2 = 0.0; ///< fastest change of speed along the path, up or down
};

} // namespace octant::sim
