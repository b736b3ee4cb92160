#pragma once

#include "ui/report/flight_accumulator.h"
#include "ui/report/frame_record.h"
#include "ui/report/packed_recording.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// A recording read back. The figures come from frames.csv, whether the flight ended or not.
struct LoadedRecording {
    RecordingFolder folder;
    std::string name;         ///< the folder's own name
    std::string display_name; ///< the folder or file that was given
    /// Of frame times that another program recorded (frame_capture.h): what wrote them. Such a recording has frame
    /// times, a title, facts and machine, and nothing else. Empty for Octant's own recordings.
    std::string capture_format;
    RunFile run;
    FlightAccumulator flight;
    Statistics statistics;
    /// The slowest frames, the slowest first, with what the kernel counted where the recording has that.
    std::vector<SlowFrame> slowest;
    bool has_counters = false;
    bool ended_early = false; ///< killed: no summary in run.json
    /// How run.json's summary differs from frames.csv, and the first gap in the rows: "frames: 230 in run.json, 120 by
    /// the rows; line 7 of frames.csv: expected frame 5, got 6". Empty where they agree or there is no summary.
    std::string disagreement;
    std::vector<std::filesystem::path> pictures; ///< in frame order
};

using Recordings = std::span<const LoadedRecording>;

/// The frame of "picture-00042.png", nothing for other names.
std::optional<long> picture_frame(std::string_view name);

/// Reads a recording, packed or not, a killed one too: then a torn last line of frames.csv is left out. Of any other
/// file it reads the frame times that another program recorded (frame_capture.h). Throws Error for what is none of
/// these or is damaged.
LoadedRecording load_recording(const std::filesystem::path& folder_or_file);

/// Reads recordings in this order. Where there are several, each keeps only what a page of several shows
/// (FlightAccumulator::keep_frame_times), so that ten thousand fit into memory. Throws Error as load_recording().
std::vector<LoadedRecording> load_recordings(std::span<const std::filesystem::path> folders_or_zips);

} // namespace octant::ui::report
