#pragma once

#include "sim/aircraft_table.h"

#include <span>
#include <string_view>

namespace octant::sim {

/// All types that are known, in the order in which messages list them.
std::span<const AircraftKind> aircraft_kinds();

/// The type of a name; null for a name that none has.
const AircraftKind* find_aircraft_kind(std::string_view name);

/// The type of a name. Throws Error "expected aircraft f15 or 500md or ..., got ..." for a name
/// that none has.
const AircraftKind& aircraft_kind(std::string_view name);

} // namespace octant::sim
