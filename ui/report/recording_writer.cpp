#include "ui/report/recording_writer.h"

#include "sim/base/error.h"
#include "ui/report/frame_csv.h"
#include "ui/report/kernel_counters.h"
#include "ui/report/png_file.h"
#include "ui/report/recording_names.h"
#include "ui/report/timing_files.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;

/// The folder's entries; throws Error when it cannot be read.
std::vector<fs::path> entries_of(const fs::path& folder) {
    std::error_code code;
    std::vector<fs::path> entries;
    for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        entries.push_back(at->path());
    }
    if (code) {
        throw_error_in(folder, fmt::format("cannot be read: {}", code.message()));
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

fs::path create_folder(fs::path folder) {
    make_folder(folder);
    return folder;
}

/// Makes the folder, which is locked, ready for a new recording.
void prepare(const fs::path& folder) {
    const std::vector<fs::path> entries = entries_of(folder);
    const auto foreign = std::find_if(entries.begin(), entries.end(), [](const fs::path& entry) {
        const std::string name = entry.filename().string();
        return name != lock_name && !is_unfinished(entry);
    });
    if (foreign != entries.end() && !is_run_file(folder / "run.json")) {
        throw_error_in(
            folder,
            fmt::format(
                "expected an empty folder or a recording to replace, got one with '{}'",
                printable(foreign->filename().string())));
    }
    for (const fs::path& entry : entries) {
        const std::string name = entry.filename().string();
        std::error_code code;
        if (name == lock_name || !is_recording_name(name)) {
            continue;
        }
        fs::remove_all(entry, code);
        if (code) {
            throw_error_in(entry, fmt::format("cannot be removed: {}", code.message()));
        }
    }
}

/// run.json before frames.csv: where there are frames there is a run.json that says whose. The
/// copies of what the run reads are written and forgotten.
fs::path begin_recording(const fs::path& folder, RunInfo& info) {
    prepare(folder);
    for (const auto& [name, bytes] : std::exchange(info.files, {})) {
        const fs::path way = fs::path(name).lexically_normal();
        if (way.is_absolute() || way.empty() || *way.begin() != "inputs") {
            throw_error_in(folder, "expected a name in inputs/, got '" + printable(name) + "'");
        }
        make_folder((folder / name).parent_path());
        write_file(folder / name, bytes);
    }
    write_file(folder / "run.json", run_json(info));
    return folder / "frames.csv";
}

} // namespace

RecordingWriter::RecordingWriter(fs::path folder, RunInfo info, int flush_every_frames)
    : folder_(create_folder(std::move(folder)))
    , lock_(folder_)
    , info_(std::move(info))
    , flush_every_frames_(flush_every_frames)
    , frames_file_(begin_recording(folder_, info_))
    , mangohud_file_(folder_ / "mangohud.csv")
    , trace_file_(folder_ / "trace.json")
    , counters_file_(folder_ / counters_name) {
    assert(flush_every_frames >= 1);
    frames_file_.append(frame_csv_header());
    mangohud_file_.append(mangohud_head(info_.machine, info_.device));
    trace_file_.append(trace_head());
    counters_file_.append(counters_header());
    flush();
}

void RecordingWriter::flush() {
    frames_file_.flush();
    mangohud_file_.flush();
    trace_file_.flush();
    counters_file_.flush();
    unflushed_frames_ = 0;
}

/// Every frame at first, then only those that were slow: trace viewers take no more.
void RecordingWriter::add_to_trace(const FrameRecord& record) {
    constexpr std::size_t max_bytes = std::size_t{48} << 20;
    constexpr std::size_t max_bytes_of_slow_ones = std::size_t{64} << 20;
    if (trace_bytes_ < (record.overrun != 0 ? max_bytes_of_slow_ones : max_bytes)) {
        const std::string events = trace_events(record);
        trace_bytes_ += events.size();
        trace_file_.append(events);
    }
}

void RecordingWriter::add(const FrameRecord& record) {
    constexpr double flush_every_s = 0.5;
    const FrameRecord written = rounded_as_csv(record);
    times_.add(written);
    frames_file_.append(frame_csv_line(record));
    mangohud_file_.append(mangohud_line(written));
    add_to_trace(written);
    counters_file_.append(counters_line(written));
    const bool many = ++unflushed_frames_ >= flush_every_frames_;
    if (many || record.wall_s - flushed_wall_s_ >= flush_every_s) {
        flush();
        flushed_wall_s_ = record.wall_s;
    }
}

fs::path RecordingWriter::picture_path(int frame) const {
    return folder_ / fmt::format("picture-{:05}.png", frame);
}

void RecordingWriter::add_picture(int frame, const PixelView& picture) const {
    write_png(picture_path(frame), picture);
}

void RecordingWriter::set_settings(std::string settings_json) {
    info_.settings_json = std::move(settings_json);
    write_file(folder_ / "run.json", run_json(info_));
}

Statistics RecordingWriter::finish(const RunSummary& end) {
    frames_file_.flush();
    const Statistics statistics = times_.statistics();
    write_file(folder_ / "run.json", run_json(info_, end, statistics));
    trace_file_.append(trace_end());
    flush();
    return statistics;
}

} // namespace octant::ui::report
