#pragma once

#include "ui/base/json_value.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/replay.h"
#include "ui/flight/sender.h"
#include "ui/flight/session.h"
#include "ui/settings/settings.h"

#include <optional>
#include <string>

namespace octant::ui::flight {

/// Flies the frames of the session, or those of `time.part`: each is drawn, sent and recorded, in real time where
/// `time.realtime` says so. A received stop signal ends the flight after the frame that is being drawn; the returned
/// text then says so, else it is empty. Throws Error.
std::string fly_frames(
    const settings::TimeSettings& time, bool quiet, Session& session, Sender& sender, FlightRecorder& recorder);

/// Prints the statistics and hashes of a flight to standard output, as a table or as JSON. `extra_results` are only in
/// JSON.
void print_result(const FlightResult& result, const std::optional<ReplayComparison>& comparison, bool json,
    const base::JsonValue::JsonMembers& extra_results = {});

} // namespace octant::ui::flight
