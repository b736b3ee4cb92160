#pragma once

#include "ui/flight/flight_recorder.h"
#include "ui/flight/live_flight.h"
#include "ui/flight/session.h"

#include <memory>
#include <string>

namespace octant::ui::flight {

/// A live flight that was flown again.
struct PacketReplay {
    /// Must outlive the session's last use.
    std::unique_ptr<LiveFlight> live;
    /// What ended it before its last picture, empty = nothing did.
    std::string stopped;
};

/// Flies a recorded live flight again in a session of its settings: the same packets for the same pictures, until a
/// stop signal comes. Throws Error.
PacketReplay replay_packets(const Replay& replay, Session& session, FlightRecorder& recorder, bool quiet);

} // namespace octant::ui::flight
