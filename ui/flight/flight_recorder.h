#pragma once

#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"
#include "ui/flight/session.h"
#include "ui/report/recording_writer.h"
#include "ui/report/slow_pictures.h"
#include "ui/report/statistics.h"
#include "ui/report/video_pipe.h"
#include "ui/settings/settings.h"
#include "ui/world/world.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Writes track.csv and track.acmi into a folder for a flight that left the world's path: `flight` holds its samples,
/// `frame` is the world's place on the earth, null if unknown. Throws Error.
void write_tracks(const std::filesystem::path& folder, const world::World& world, const sim::Trajectory& flight,
    const EarthFrame* frame);

/// Files that a flight leaves.
struct RecordOptions {
    std::optional<std::filesystem::path> folder;
    std::optional<std::filesystem::path> video;
    /// The recording whose frames this flight repeats.
    std::optional<std::filesystem::path> replay_of;
    /// How a sweep shares the machine between this flight and others, for reports; empty = no sweep.
    std::string machine_sharing;
};

/// What came out of a flight.
struct FlightResult {
    report::Statistics statistics;
    std::uint64_t state_hash = 0;
    std::uint64_t picture_hash = 0;
    /// Where results are.
    std::vector<std::string> notes;
    /// One sentence for each requested output whose program is not installed.
    std::vector<std::string> missing_programs;
    /// The error of an output other than the recording, such as the video; empty = none.
    std::string fault;
};

/// True when the folder holds a finished recording of these settings and input files by this very program file, and the
/// video is there where one was asked for.
bool is_already_recorded(const RecordOptions& options, const settings::RunSettings& settings);

/// What run.json says of a flight that is recorded into a folder. Settings name files absolutely.
report::RunInfo run_info(
    const settings::RunSettings& settings, const Session& session, const std::filesystem::path& folder);

/// Writes report.html of a recording's folder. Returns a note with its path. Throws Error.
std::string write_report(const std::filesystem::path& folder);

/// A picture as the report's files take it; refers to it.
report::PixelView pixel_view_of(const visuals::scene::Picture& picture);

/// Writes a flight as it is flown: recording folder, pictures, video. Without a folder only the figures are kept.
class FlightRecorder {
public:
    /// Makes the folder with run.json and the track files. Throws Error.
    FlightRecorder(const RecordOptions& options, const settings::RunSettings& settings, const Session& session);
    ~FlightRecorder();
    FlightRecorder(const FlightRecorder&) = delete;
    FlightRecorder& operator=(const FlightRecorder&) = delete;
    FlightRecorder(FlightRecorder&&) = delete;
    FlightRecorder& operator=(FlightRecorder&&) = delete;

    /// Takes the frame that the session has just drawn. Throws Error (disk full).
    void add(report::FrameRecord record, Session& session);

    /// Ends the recording and writes its report. `stopped` says what ended the flight before its last frame, empty =
    /// nothing did. Throws Error.
    FlightResult finish(const Session& session, const std::string& stopped = {});

private:
    RecordOptions options_;
    int picture_every_ = 0;
    std::optional<report::RecordingWriter> recording_;
    report::SlowPictures slow_pictures_;
    /// Null without a folder.
    std::unique_ptr<class TrackFiles> tracks_;
    std::optional<report::VideoPipe> video_;
    /// The times of frames where there is no folder.
    report::FrameTimeHistogram times_;
    double flown_until_s_ = 0.0;
};

} // namespace octant::ui::flight
