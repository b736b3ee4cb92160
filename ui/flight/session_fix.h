#pragma once

#include "sim/aircraft_state.h"
#include "sim/links/fix.h"
#include "ui/flight/session.h"

namespace octant::ui::flight {

/// An aircraft's motion as packets have it: geodetic by the session's place on the earth, or around
/// 0 N, 0 E where its ground has none.
sim::links::Fix fix_of(const Session& session, const sim::AircraftState& state);

} // namespace octant::ui::flight
