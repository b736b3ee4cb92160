#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/piloted_flight.h"

#include <glm/vec3.hpp>

#include <memory>

namespace octant::sim {

/// Takes an aircraft over in this state, as it is: position, velocity, attitude and load factor go on from there.
std::unique_ptr<PilotedFlight> make_piloted_flight(const AircraftKind& kind, const AircraftState& start);

/// Level, wings level, unaccelerated: where a flight from trim begins. `speed_mps` true airspeed; heading clockwise
/// from north.
AircraftState trimmed_state(
    const AircraftKind& kind, const glm::dvec3& position_m, double heading_rad, double speed_mps);

/// How much of its reheat an aircraft burns in this motion: 0 = dry thrust does, 1 = all of it. The thrust follows from
/// the energy, T = D + m (dV/dt + g sin(climb)): E. S. Rutowski, "Energy Approach to the General Aircraft Performance
/// Problem", J. Aeronautical Sciences 21(3), 1954, with the drag, mass and engines of the kind (fixed_wing_flight.cpp
/// names their sources) in still standard air. Null, a shape of which nothing is known, counts as the F-15. Helicopters
/// have none.
double reheat_fraction(const AircraftKind* kind, const AircraftState& state);

} // namespace octant::sim
