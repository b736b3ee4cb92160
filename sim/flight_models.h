#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/hand_flight.h"

#include <glm/vec3.hpp>

#include <memory>

namespace octant::sim {

/// Takes an aircraft over in this state, as it is: position, velocity, attitude and load factor go
/// on from there.
std::unique_ptr<HandFlight> hand_flight(const AircraftKind& kind, const AircraftState& start);

/// Level, wings level, unaccelerated: where a flight from trim begins. `speed_mps` true airspeed;
/// heading clockwise from north.
AircraftState trimmed_state(
    const AircraftKind& kind, const glm::dvec3& position_m, double heading_rad, double speed_mps);

} // namespace octant::sim
