#include "ui/report/recording.h"

#include "sim/base/error.h"
#include "ui/report/frame_csv.h"
#include "ui/report/png_file.h"
#include "ui/report/timing_files.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;

/// True for the names that a recording gives its files, and for what a kill left of writing one.
bool is_recording_name(std::string_view name) {
    constexpr std::array<std::string_view, 8> names{
        "run.json",
        "frames.csv",
        "mangohud.csv",
        "trace.json",
        "track.acmi",
        "track.csv",
        "flight.csv",
        "report.html"};
    return is_unfinished(name) || (name.starts_with("picture-") && name.ends_with(".png")) ||
           std::find(names.begin(), names.end(), name) != names.end();
}

/// The folder's entries; throws Error when it cannot be read.
std::vector<fs::path> entries_of(const fs::path& folder) {
    std::error_code code;
    std::vector<fs::path> entries;
    for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        entries.push_back(at->path());
    }
    if (code) {
        error_in(folder, fmt::format("cannot be read: {}", code.message()));
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

/// Makes the folder ready for a new recording.
fs::path prepared(fs::path folder) {
    make_folder(folder);
    const std::vector<fs::path> entries = entries_of(folder);
    const auto foreign = std::find_if(entries.begin(), entries.end(), [](const fs::path& entry) {
        return !is_unfinished(entry);
    });
    if (foreign != entries.end() && !is_run_file(folder / "run.json")) {
        error_in(
            folder,
            fmt::format(
                "expected an empty folder or a recording to replace, got one with '{}'",
                printable(foreign->filename().string())));
    }
    for (const fs::path& entry : entries) {
        std::error_code code;
        if (is_recording_name(entry.filename().string()) && !fs::remove(entry, code) && code) {
            error_in(entry, fmt::format("cannot be removed: {}", code.message()));
        }
    }
    return folder;
}

/// run.json before frames.csv: where there are frames there is a run.json that says whose.
fs::path begun(const fs::path& folder, const RunInfo& info) {
    write_file(folder / "run.json", run_json(info));
    return folder / "frames.csv";
}

} // namespace

Recording::Recording(fs::path folder, RunInfo info, int flush_every_frames)
    : folder_(prepared(std::move(folder)))
    , info_(std::move(info))
    , flush_every_frames_(flush_every_frames)
    , frames_file_(begun(folder_, info_)) {
    assert(flush_every_frames >= 1);
    frames_file_.append(frame_csv_header());
    frames_file_.flush();
}

void Recording::add(const FrameRecord& record) {
    constexpr double flush_every_s = 0.5;
    records_.push_back(as_written(record));
    frames_file_.append(frame_csv_line(record));
    const bool many =
        records_.size() - flushed_records_ >= static_cast<std::size_t>(flush_every_frames_);
    if (many || record.wall_s - flushed_wall_s_ >= flush_every_s) {
        frames_file_.flush();
        flushed_records_ = records_.size();
        flushed_wall_s_ = record.wall_s;
    }
}

fs::path Recording::picture_path(int frame) const {
    return folder_ / fmt::format("picture-{:05}.png", frame);
}

void Recording::add_picture(int frame, const PictureView& picture) const {
    write_png(picture_path(frame), picture);
}

void Recording::set_settings(std::string settings_json) {
    info_.settings_json = std::move(settings_json);
    write_file(folder_ / "run.json", run_json(info_));
}

Statistics Recording::finish(const RunEnd& end) {
    frames_file_.flush();
    const Statistics statistics = statistics_of(records_);
    write_file(folder_ / "mangohud.csv", mangohud_csv(records_, info_.machine, info_.device));
    write_file(folder_ / "trace.json", trace_json(records_));
    write_file(folder_ / "run.json", run_json(info_, end, statistics));
    return statistics;
}

} // namespace octant::ui::report
