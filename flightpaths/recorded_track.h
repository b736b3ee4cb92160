#pragma once

#include "flightpaths/track_recording.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::flightpaths {

struct RecordedTrack {
    /// At least 2 samples.
    sim::Trajectory trajectory;
    /// Where the first sample lies, set when the recording gives latitude and longitude: it is at x = y = 0 of a
    /// TransverseMercator frame there; heights stay those of the recording, above datum.
    std::optional<GeoPosition> origin;
    /// What a person should be told of it.
    std::vector<std::string> notes;
};

/// The motion of the followed aircraft of a file that parse_track_recording() reads (track_recording.h). A quaternion
/// of unit length, rounding aside, is not normalised again, so a track that exact_track_csv wrote is read back to the
/// last bit. Throws Error as parse_track_recording(); for tables of Octant and JSBSim with file and line also for a
/// missing or doubled column, too few or too many fields, a value that is not a finite number, times that do not
/// increase, span more than a day or are more than 1e7 s from zero, a speed above 3000 m/s, or a quaternion whose
/// length differs from 1 by more than 1e-6.
RecordedTrack read_recorded_track(const std::filesystem::path& file);

} // namespace octant::flightpaths
