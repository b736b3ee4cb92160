#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

#include <vector>

namespace octant::flightpaths {

/// Transforms a path from the axes of one frame to those of another one, relative to the position of the origin of the
/// first frame in the second: each sample stays over its place on the earth, and attitude and velocity keep their
/// directions from true north. If the planets of the frames differ in size, speed over the ground is scaled like the
/// distances.
sim::Trajectory reprojected(const sim::Trajectory& path, const EarthFrame& from, const EarthFrame& to);

/// What a recording lacks, made from the motion it has. At least two samples with increasing times.

/// Velocities from the positions: the slope of the parabola through a sample and its neighbours; at the ends that of
/// the parabola through the last three (through two, if there are no more).
void fill_velocities(std::vector<sim::AircraftState>& samples);

/// Attitudes of coordinated flight from the velocities: nose along the velocity, lift against gravity and the change of
/// velocity. Where that sum is under 0.1 g, the last lift direction is kept; where the aircraft stands still (under 0.1
/// m/s), the last attitude is kept.
void fill_attitudes(std::vector<sim::AircraftState>& samples);

/// Load factors from velocities and attitudes: the part of the felt acceleration along body up.
void fill_load_factors(std::vector<sim::AircraftState>& samples);

} // namespace octant::flightpaths
