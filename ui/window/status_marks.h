#pragma once

#include "sim/piloted_flight.h"
#include "ui/window/view_state.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::window {

/// A word of the status line, which is seen even while panels are hidden.
struct StatusMark {
    std::string text;
    bool warns = false;
};

/// What the status line says of an aircraft that is flown by hand.
struct ManualFlightStatus {
    sim::FlightWarnings warnings;
    /// The flight has ended: the aircraft left the map or met the ground.
    bool ended = false;
    /// The flight ended because the aircraft left the map.
    bool off_the_map = false;
    /// It is being flown level (Simulation::level_off).
    bool levelling = false;
};

/// Returns those of the marks "REC folder", "paused", "x0.5", "x0.67 of real time", "by hand", "STALL", ... that hold
/// now, in this order.
std::vector<StatusMark> status_marks(const ViewState& state, const std::optional<ManualFlightStatus>& manual_flight);

} // namespace octant::ui::window
