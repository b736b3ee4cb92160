#include "ui/report/loaded_recording.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/report/frame_capture.h"
#include "ui/report/frame_csv.h"
#include "ui/report/kernel_counters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pictures_in(const fs::path& folder) {
    std::vector<std::pair<long, fs::path>> found;
    std::error_code code;
    for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        if (const auto frame = picture_frame(at->path().filename().string())) {
            found.emplace_back(*frame, at->path());
        }
    }
    std::sort(found.begin(), found.end());
    std::vector<fs::path> pictures;
    pictures.reserve(found.size());
    for (auto& [frame, path] : found) { pictures.push_back(std::move(path)); }
    return pictures;
}

/// Adds the rows to a flight. Says which is the first that does not follow the one before it, as where a line was lost;
/// else gives an empty text.
std::string read_rows(const fs::path& file, FlightAccumulator& flight) {
    FrameReader rows(file);
    std::string gap;
    int line = 1;
    std::optional<std::int64_t> next;
    while (const auto row = rows.next()) {
        ++line;
        if (gap.empty() && next && row->frame != *next) {
            gap = fmt::format("line {} of frames.csv: expected frame {}, got {}", line, *next, row->frame);
        }
        next = std::int64_t{row->frame} + 1;
        flight.add(*row);
    }
    return gap;
}

/// Figures in which run.json's summary is not that of the rows, whose last digits it rounds.
std::string disagreement_of(const RunFile& run, const Statistics& statistics) {
    std::string text;
    for (const Statistic& statistic : all_statistics()) {
        const std::string told = value_of(run.summary, statistic.key);
        const auto value = finite_number(told);
        const double by_rows = statistic.value(statistics);
        if (value && std::abs(*value - by_rows) > 1e-6 * std::max(1.0, std::abs(by_rows))) {
            text += fmt::format("{}{}: {} in run.json, {:.{}f} by the rows", text.empty() ? "" : "; ", statistic.key,
                told, by_rows, statistic.decimals);
        }
    }
    return text;
}

void read_files(LoadedRecording& recording) {
    const fs::path& folder = recording.folder.path;
    recording.run = read_run_file(folder / "run.json");
    std::string gap;
    if (path_exists(folder / "frames.csv") || recording.run.ended) {
        gap = read_rows(folder / "frames.csv", recording.flight);
    }
    recording.statistics = recording.flight.times().statistics();
    recording.slowest = recording.flight.slow.slowest();
    recording.has_counters = read_counters(folder / counters_name, recording.slowest);
    recording.ended_early = !recording.run.ended;
    recording.disagreement = disagreement_of(recording.run, recording.statistics);
    recording.disagreement += (gap.empty() || recording.disagreement.empty() ? "" : "; ") + gap;
    recording.pictures = pictures_in(folder);
}

LoadedRecording loaded_capture(const fs::path& file) {
    FrameCapture capture = read_frame_capture(file);
    LoadedRecording recording;
    recording.folder.path = file;
    recording.name = file.filename().string();
    recording.display_name = file.string();
    recording.capture_format = std::move(capture.format);
    recording.run = std::move(capture.run);
    FrameRecord record;
    for (const FrameTime& frame : capture.frames) {
        record.sim_time_s = record.wall_s = frame.time_s;
        record.frame_ms = frame.frame_ms;
        record.overrun = frame.frame_ms > overrun_16_ms ? 1 : 0;
        recording.flight.add(record);
        ++record.frame;
    }
    recording.statistics = recording.flight.times().statistics();
    recording.slowest = recording.flight.slow.slowest();
    return recording;
}

} // namespace

std::optional<long> picture_frame(std::string_view name) {
    constexpr std::string_view before = "picture-";
    constexpr std::string_view after = ".png";
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) {
        return std::nullopt;
    }
    name.remove_prefix(before.size());
    name.remove_suffix(after.size());
    return whole_number(name);
}

LoadedRecording load_recording(const fs::path& folder_or_file) {
    if (is_frame_capture(folder_or_file)) { return loaded_capture(folder_or_file); }
    LoadedRecording recording;
    recording.folder = open_recording(folder_or_file);
    recording.display_name = folder_or_file.string();
    if (!is_folder(recording.folder.path)) {
        throw_error_in(folder_or_file, "expected the folder of a recording, found none");
    }
    const fs::path whole = fs::absolute(recording.folder.path).lexically_normal();
    recording.name = (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
    base::with_named_errors([&] { read_files(recording); });
    return recording;
}

std::vector<LoadedRecording> load_recordings(std::span<const fs::path> folders_or_zips) {
    std::vector<LoadedRecording> recordings;
    recordings.reserve(folders_or_zips.size());
    for (const fs::path& each : folders_or_zips) {
        recordings.push_back(load_recording(each));
        if (folders_or_zips.size() == 1) { break; }
        recordings.back().flight.keep_frame_times(max_curve_pieces(folders_or_zips.size()));
        recordings.back().slowest = {};
    }
    return recordings;
}

} // namespace octant::ui::report
