#pragma once

#include "ui/base/figures.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/replay.h"

#include <optional>

namespace octant::ui::commands {

/// Prints the figures and hashes of a flight to standard output, as a table or as JSON; `further`
/// figures only as JSON.
void print_summary(
    const flight::FlightEnd& end,
    const std::optional<flight::ReplayVerdict>& verdict,
    bool json,
    const base::Figures::Named& further = {});

} // namespace octant::ui::commands
