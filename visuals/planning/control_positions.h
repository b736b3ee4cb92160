#pragma once

#include "models/part_motion.h"
#include "sim/aircraft_state.h"
#include "visuals/landscape/ground.h"

namespace octant::visuals::planning {

/// Where an aircraft's controls stand, guessed from its motion alone: ailerons by its roll rate, elevator by load
/// factor and pitch rate, rudder by what its yaw rate has beyond that of a coordinated turn, speed brakes by loss of
/// speed, gear and flaps near the ground and slow, but up where there is no ground. Gear moves on an approach and after
/// take-off; in level flight it is up or down. Depends on nothing else, so that every picture of a state is the same.
models::ControlPositions control_positions(const sim::AircraftState& state, const landscape::Ground& ground);

} // namespace octant::visuals::planning
