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

/// Writes track.csv and track.acmi of a flight that left the world's path into a folder: `flight` holds its samples,
/// `frame` says how the world lies on the earth, null where that is not known. Throws Error.
void write_tracks(const std::filesystem::path& folder, const world::World& world, const sim::Trajectory& flight,
    const EarthFrame* frame);

/// What is kept of a flight.
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

/// Makes a folder's report.html anew; gives a line that says where it is. Throws Error.
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

/// A recording to repeat frame by frame: targets and hashes read from it.
struct Replay {
    std::filesystem::path folder;
    /// By frame, at least one.
    std::vector<QualityTargets> quality_targets;
    /// False where it was killed and has no hashes.
    bool ended = false;
    /// Sixteen hex digits.
    std::string state_hash;
    std::string picture_hash;
};

/// Reads run.json and frames.csv of a recording, a killed one too; its settings are for read_settings(). Throws Error
/// with file and line for rows that are damaged, missing among others or without a triangle target.
Replay read_replay(const std::filesystem::path& folder);

/// Throws Error when the recording has more rows than its settings make frames.
void check_frames(const Replay& replay, int frames);

/// How a replay compares with its recording.
struct ReplayComparison {
    /// "same", "other" or "unknown" (the recording was killed).
    std::string state_hash;
    /// "same", "other" or "unknown", as state_hash.
    std::string picture_hash;
    /// Whether both hashes are known to be the same.
    bool is_same = false;
    /// All of it for people.
    std::string line;
};

ReplayComparison compare_with_recording(const Replay& replay, std::uint64_t state_hash, std::uint64_t picture_hash);

} // namespace octant::ui::flight
