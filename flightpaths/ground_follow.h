#pragma once

#include "sim/aircraft_limits.h"
#include "sim/trajectory.h"

#include <vector>

namespace octant::flightpaths {

struct RaisedPath {
    sim::Trajectory trajectory;
    /// False where nothing but one lift for all heights fits the limits.
    bool follows = true;
};

/// Lifts a path over ground, changing in time.
///
/// `needed_m` is what must at least be added to the path's height at each step of sim::step_s from
/// its start; the result adds at least that at every step. It climbs no faster than the aircraft
/// can beside what the path climbs already, sinks no faster than it can climb, and both no steeper
/// than 1 in 4. It is rounded over the shortest time that keeps the load factor within half of the
/// aircraft's margins (or near the path's own, where that is beyond) and its onset within the
/// limit; where no time does, or none short of levelling the whole path, that is lifted by one
/// height and `follows` is false.
///
/// Speed along the ground stays; velocity, pitch and load factor follow the new path; bank stays.
RaisedPath raised_over_ground(
    const sim::Trajectory& path,
    const std::vector<double>& needed_m,
    const sim::AircraftLimits& limits);

/// The smallest curve over `needed_m` that rises by at most `up_m[i]` from i to i+1 and falls by at
/// most `down_m[i]`. All three of one length.
std::vector<double> slope_limited(
    std::vector<double> needed_m,
    const std::vector<double>& up_m,
    const std::vector<double>& down_m);

} // namespace octant::flightpaths
