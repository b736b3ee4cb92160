#pragma once

#include "ui/flight/live_flight.h"
#include "ui/flight/session.h"

#include <optional>
#include <string>

namespace octant::ui::flight {

// What a live flight changes in the session that it flies beside the aircraft: only this knows both.

/// To be called before each picture: tells the flight what shape the session's pictures have, and gives the session the
/// visibility that a CIGI host has told.
void apply_host_visibility(LiveFlight& live, Session& session);

/// After apply_host_visibility(): brings the sun to the time of day that a CIGI host has told; in steps at once, else
/// as soon as the ground's colours are made, beside other pictures. Returns the time that pictures show from this one
/// on, where it is another one.
std::optional<std::string> apply_host_time_of_day(const LiveFlight& live, Session& session);

/// For a flight that is repeated: brings the sun to the time of day that apply_host_time_of_day() gave then.
void set_time_of_day(const std::string& time_of_day, Session& session);

} // namespace octant::ui::flight
