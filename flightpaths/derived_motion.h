#pragma once

#include "sim/aircraft_state.h"

#include <vector>

namespace octant::flightpaths {

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
