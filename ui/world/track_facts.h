#pragma once

#include "flightpaths/ground_contact.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "ui/report/track_picture.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::world {

/// Names and values for a person.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// "2024-01-02 07:41:03 UTC".
std::string utc_text(double since_1970_s);

/// Times without a sample that are longer than this are gaps of a track, unless all its samples are so far apart.
inline constexpr double track_gap_s = 30.0;

/// A time without samples of an aircraft.
struct TrackGap {
    double from_s = 0.0;
    double to_s = 0.0;
};

/// The gaps of an aircraft's samples: longer than track_gap_s and than five times the usual step.
std::vector<TrackGap> gaps_of(const flightpaths::TrackedAircraft& aircraft);

/// Which quantities an aircraft's samples have, and how many of them: "place 120 of 120, height 120, roll and pitch 0".
std::string measured_text(const flightpaths::TrackedAircraft& aircraft);

/// The aircraft of a recording for a picture of its track.
std::vector<report::TrackCurve> track_curves(const flightpaths::TrackRecording& recording);

/// What was made from the samples: where velocity, heading, pitch and roll come from, errors, phases, wind.
NamedTexts inferred_facts(const flightpaths::TrackInference& inference);

/// What was done to lay a track on the ground: its times there, altimeter settings; empty where nothing was.
NamedTexts contact_facts(const flightpaths::GroundContactReport& report);

/// "name text; name text".
std::string text_of_facts(const NamedTexts& facts);

/// What a recorded track holds, of each of its aircraft: format, time, what was measured, inferred and left out, and
/// how it was laid on the ground. `inferences`, `contacts`: of each aircraft, or none.
NamedTexts track_facts(const flightpaths::TrackRecording& recording,
    std::span<const flightpaths::TrackInference> inferences,
    std::span<const flightpaths::GroundContactReport> contacts);

} // namespace octant::ui::world
