#pragma once

#include "sim/aircraft_state.h"

namespace octant::ui {

/// State of wingman `number` (from 1) beside a leader: in echelon behind him, alternately to the
/// right and left, 15 m back and 17 m aside for each rank, level with him, in the same attitude.
sim::AircraftState wingman_of(const sim::AircraftState& leader, int number);

/// How far the last wingman is from the leader when `aircraft` fly together, metres; 0 for one.
double formation_radius_m(int aircraft);

} // namespace octant::ui
