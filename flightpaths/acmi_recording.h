#pragma once

#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// An aircraft of a Tacview recording: at least 2 samples, in a TransverseMercator frame at the recording's origin and
/// metres above the sea, seconds since the first sample of any aircraft.
struct RecordedAircraft {
    /// As the recording has it; empty if it has none.
    std::string name;
    /// Its tags, such as "Air+Rotorcraft"; empty if it has none.
    std::string type;
    sim::Trajectory trajectory;
};

struct AcmiRecording {
    /// The one seen longest comes first, the others in the order in which they appear. Not empty.
    std::vector<RecordedAircraft> aircraft;
    /// Where the first one is seen first.
    GeoPosition origin;
    /// What was left out, and why, a line each.
    std::vector<std::string> notes;
};

inline constexpr std::size_t max_recorded_aircraft = 256;

/// Reads Tacview's ACMI 2.x text ("Technical Reference - ACMI flight recordings 2.2"): objects whose tags have Air
/// among them, or that have none. What moves by fewer than 2 samples, lies more than 1,000 km from the first or is one
/// of too many is left out, so are samples that would need more than 3,000 m/s. Missing attitudes and velocities are
/// derived from the motion (derived_motion.h). `file` names the recording in messages. Throws Error with file and line
/// for other text, what is no number where one belongs, more than a day, more than a million objects or 20 million
/// places, and a recording without any aircraft.
AcmiRecording parse_acmi(std::string_view text, const std::filesystem::path& file);

} // namespace octant::flightpaths
