#pragma once

#include "sim/hand_flight.h"
#include "ui/window/view_state.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::window {

/// A word that is always to be seen.
struct StatusMark {
    std::string text;
    bool warns = false;
};

/// By hand: what the aircraft does.
struct HandStatus {
    sim::FlightWarnings warnings;
    bool ended = false;       ///< it flies no further
    bool off_the_map = false; ///< why; else it met the ground
};

/// "REC folder", "paused", "x0.5", "by hand", "STALL", ... in this order; each where it holds.
std::vector<StatusMark> status_marks(const ViewState& state, const std::optional<HandStatus>& hand);

} // namespace octant::ui::window
