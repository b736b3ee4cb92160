#include "sim/aircraft_kind.h"

#include "sim/base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace octant::sim {

std::span<const AircraftKind> aircraft_kinds() { return aircraft_table; }

const AircraftKind* find_aircraft_kind(std::string_view name) {
    const auto found = std::ranges::find(aircraft_table, name, &AircraftKind::name);
    return found == aircraft_table.end() ? nullptr : &*found;
}

const AircraftKind& aircraft_kind(std::string_view name) {
    if (const AircraftKind* kind = find_aircraft_kind(name)) { return *kind; }
    std::string names;
    for (const AircraftKind& kind : aircraft_table) {
        names += names.empty() ? "" : " or ";
        names += kind.name;
    }
    throw Error(fmt::format("expected aircraft {}, got '{}'", names, printable(std::string(name))));
}

} // namespace octant::sim
