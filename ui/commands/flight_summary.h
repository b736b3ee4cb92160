#pragma once

#include "ui/flight/flight_recorder.h"
#include "ui/flight/replay.h"

#include <optional>

namespace octant::ui::commands {

/// Prints the figures and hashes of a flight to standard output, as a table or as JSON.
void print_summary(
    const flight::FlightEnd& end, const std::optional<flight::ReplayVerdict>& verdict, bool json);

} // namespace octant::ui::commands
