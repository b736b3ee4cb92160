#pragma once

#include "ui/base/json_value.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/replay.h"

#include <optional>

namespace octant::ui::commands {

/// Prints the figures and hashes of a flight to standard output, as a table or as JSON; `extra_results` figures only as
/// JSON.
void print_summary(const flight::FlightResult& end, const std::optional<flight::ReplayComparison>& verdict, bool json,
    const base::JsonValue::JsonMembers& extra_results = {});

} // namespace octant::ui::commands
