#pragma once

namespace octant::flightpaths {

/// What no track goes beyond: a speed, a distance from its origin, a time from its first sample.
inline constexpr double fastest_track_mps = 3000.0;
inline constexpr double furthest_track_m = 1e7;
inline constexpr double longest_track_s = 86400.0;

} // namespace octant::flightpaths
