#include "flightpaths/recorded_track.h"

#include "flightpaths/track_motion.h"
#include "sim/base/text_file.h"

#include <utility>

namespace octant::flightpaths {

RecordedTrack read_recorded_track(const std::filesystem::path& file) {
    TrackRecording recording = parse_track_recording(read_file(file), file);
    TrackMotion motion = motion_of(recording.aircraft.front());
    std::vector<std::string> notes = std::move(recording.notes);
    notes.insert(notes.end(), motion.notes.begin(), motion.notes.end());
    return {std::move(motion.trajectory), recording.origin, std::move(notes)};
}

} // namespace octant::flightpaths
