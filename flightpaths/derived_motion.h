#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

#include <vector>

namespace octant::flightpaths {

/// A path in the axes of one frame, brought to those of another one, counted from where the origin of the first lies in
/// it: each sample stays over its place on the earth, and attitude and velocity keep their directions from true north.
/// Where the frames' planets differ in size, speed over the ground is stretched as the distances are.
sim::Trajectory reprojected(const sim::Trajectory& path, const EarthFrame& from, const EarthFrame& to);

/// What a recording lacks, made from the motion it has. At least two samples with increasing times.

/// Velocities from the positions: the slope of the parabola through a sample and its neighbours; at the ends that of
/// the parabola through the last three (through two, if there are no more).
void fill_velocities(std::vector<sim::AircraftState>& samples);

/// Attitudes of coordinated flight from the velocities: nose along the velocity, lift against what gravity and the
/// change of velocity ask for. Where that is under 0.1 g the last lift direction goes on; where the aircraft stands
/// still (under 0.1 m/s) the last attitude goes on.
void fill_attitudes(std::vector<sim::AircraftState>& samples);

/// Load factors from velocities and attitudes: the part of the felt acceleration along body up.
void fill_load_factors(std::vector<sim::AircraftState>& samples);

} // namespace octant::flightpaths
