#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/piloted_flight.h"

#include <string>
#include <vector>

namespace octant::ui::window {

/// A number of a flight by hand and its name.
struct FlightReadout {
    std::string name;
    std::string value;
};

/// Returns what a pilot watches: throttle or collective, speed, height, climb, angle of attack and load factor.
std::vector<FlightReadout> flight_readouts(
    const sim::AircraftKind& kind, const sim::AircraftState& state, const sim::PilotControls& controls);

/// Makes a picture of where stick, rudder and throttle stand, beside the numbers.
void show_controls(const sim::AircraftKind& kind, const sim::AircraftState& state, const sim::PilotControls& controls);

} // namespace octant::ui::window
