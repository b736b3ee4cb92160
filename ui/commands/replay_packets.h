#pragma once

#include "ui/flight/flight_recorder.h"
#include "ui/flight/live_flight.h"
#include "ui/flight/replay.h"
#include "ui/flight/session.h"

#include <memory>

namespace octant::ui::commands {

/// Flies a recorded live flight again in a session of its settings: the same packets for the same
/// pictures. What it gives must outlive the session's last use. Throws Error.
std::unique_ptr<flight::LiveFlight> fly_packets(
    const flight::Replay& replay,
    flight::Session& session,
    flight::FlightRecorder& recorder,
    bool quiet);

} // namespace octant::ui::commands
