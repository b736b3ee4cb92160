#pragma once

#include "sim/base/output_file.h"
#include "ui/report/folder_lock.h"
#include "ui/report/frame_record.h"
#include "ui/report/png_file.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace octant::ui::report {

/// A recording being written: run.json at once; frames.csv, mangohud.csv, trace.json and counters.csv as the flight
/// goes, so that it takes no more memory the longer it is; the summary at the end. A kill loses the frames of at most
/// half a second; load_recording works on what is left. Nobody else can record into the folder meanwhile. Reads no
/// clock: time comes with the records.
class RecordingWriter {
public:
    /// Makes `folder` and its parents. In a folder that is a recording already its files are removed and all others
    /// left alone. Throws Error for a folder with anything else in it, for one that is being recorded into, and when
    /// nothing can be written there. Rows are handed to the system at the latest every `flush_every_frames` (>= 1)
    /// frames or half a second of wall_s.
    RecordingWriter(std::filesystem::path folder, RunInfo info, int flush_every_frames = 60);

    /// Appends one frame. Throws Error (disk full); nothing more may be added then.
    void add(const FrameRecord& record);

    /// Where the picture of a frame belongs: picture-00042.png.
    std::filesystem::path picture_path(int frame) const;

    /// Writes that picture, whole or not at all. May be called from another thread. Throws Error.
    void add_picture(int frame, const PixelView& picture) const;

    /// Writes run.json anew with other settings: for a flight that is not known before its end. A JSON object as text.
    /// Throws Error.
    void set_settings(std::string settings_json);

    /// Writes the summary into run.json, then ends the other files; gives the summary's figures. Once only. Throws
    /// Error.
    Statistics finish(const RunSummary& summary);

    const std::filesystem::path& folder() const { return folder_; }

private:
    void flush();
    void add_to_trace(const FrameRecord& record);

    std::filesystem::path folder_;
    FolderLock lock_;
    RunInfo info_;
    int flush_every_frames_;
    AppendedFile frames_file_;
    AppendedFile mangohud_file_;
    AppendedFile trace_file_;
    AppendedFile counters_file_;
    std::size_t trace_bytes_ = 0;
    FrameTimeHistogram times_;
    int paused_frames_ = 0;
    int unflushed_frames_ = 0;
    double flushed_wall_s_ = 0.0;
};

} // namespace octant::ui::report
