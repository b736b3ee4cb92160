#pragma once

#include "sim/aircraft_state.h"
#include "sim/links/fix.h"
#include "ui/flight/session.h"

#include <cstddef>
#include <optional>

namespace octant::ui::flight {

/// An aircraft's motion as packets have it: geodetic by the session's place on the earth, or around
/// 0 N, 0 E where its ground has none.
sim::links::Fix fix_of(const Session& session, const sim::AircraftState& state);

/// The same of an aircraft in the session's last picture; nothing for one that nobody flies or that
/// receivers would not believe.
std::optional<sim::links::Fix> flown_fix(const Session& session, std::size_t aircraft);

} // namespace octant::ui::flight
