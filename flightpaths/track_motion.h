#pragma once

#include "flightpaths/track_inference.h"
#include "flightpaths/track_recording.h"
#include "sim/trajectory.h"

#include <string>
#include <vector>

namespace octant::flightpaths {

struct TrackMotion {
    sim::Trajectory trajectory;
    TrackInference inference;
    std::vector<std::string> notes;
};

/// The motion of an aircraft by its recorded samples (at least two). A recording with all attitudes is flown through
/// its places as they are. In any other, places are smoothed within the errors that they show, and what is missing is
/// inferred: on the ground and below walking pace heading is held and the aircraft is level; in flight it banks as
/// coordinated turns need, and its nose points where its motion through the air and its lift ask for; wind is that of
/// circles flown and of measured airspeeds and headings. The trajectory may have more samples than the recording (in
/// gaps) and fewer (contradictions).
TrackMotion motion_of(const TrackedAircraft& aircraft);

} // namespace octant::flightpaths
