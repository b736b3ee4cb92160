#pragma once

namespace octant::flightpaths {

/// What no track goes beyond: a speed, a distance from its origin, a time from its first sample.
inline constexpr double max_track_speed_mps = 3000.0;
inline constexpr double max_track_distance_m = 1e7;
inline constexpr double max_track_duration_s = 86400.0;

} // namespace octant::flightpaths
