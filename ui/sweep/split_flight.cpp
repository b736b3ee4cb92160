#include "ui/sweep/split_flight.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/flight/flight_recorder.h"
#include "ui/report/frame_csv.h"
#include "ui/report/kernel_counters.h"
#include "ui/report/png_file.h"
#include "ui/report/recording_writer.h"
#include "ui/report/run_file.h"
#include "ui/report/slow_pictures.h"
#include "ui/report/statistics.h"
#include "ui/report/track_picture.h"
#include "ui/report/video_pipe.h"
#include "ui/settings/settings_check.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::sweep {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using report::FrameRecord;

/// One part's recording.
struct PartFile {
    fs::path folder;
    Json run;
    std::string host;
};

PartFile part_in(const fs::path& folder) {
    const fs::path file = folder / "run.json";
    PartFile part{folder, report::parsed_json(file, read_text_file(file)), {}};
    part.host = report::read_run_file(file).machine_info.host;
    if (!part.run.contains("summary")) {
        throw_error_in(file, "expected a part that was flown to its end, got another");
    }
    return part;
}

/// All parts must have been flown by the same program from the same files.
void check_same_flight(const PartFile& first, const PartFile& other) {
    for (const char* key : {"program", "inputs"}) {
        if (first.run.value(key, Json()) != other.run.value(key, Json())) {
            throw_error_in(other.folder / "run.json",
                fmt::format("expected the same {} on {} as on {}, got another", key, other.host, first.host));
        }
    }
}

void check_seam(
    const PartFile& before, const std::optional<FrameRecord>& last, const PartFile& now, const FrameRecord& first) {
    const bool same = last && last->frame == first.frame && last->state_hash == first.state_hash &&
                      last->picture_hash == first.picture_hash;
    if (!same) {
        throw_error_in(now.folder / "frames.csv",
            fmt::format("expected frame {} on {} as on {}, got other {}", first.frame, now.host, before.host,
                last && last->state_hash != first.state_hash ? "states" : "pictures"));
    }
}

/// The pictures of a whole flight, in order, as a video.
class PartVideo {
public:
    explicit PartVideo(const std::optional<fs::path>& file) : file_(file) {}

    void add(const fs::path& picture_file, double frames_per_s) {
        if (!file_) { return; }
        const report::Picture picture = with_alpha(report::read_png(picture_file));
        if (!pipe_) {
            pipe_.emplace(*file_, report::VideoFormat{picture.width_px, picture.height_px, 4, false, frames_per_s});
        }
        pipe_->add(picture.view());
    }

    void finish() {
        if (const auto fault = pipe_ ? pipe_->finish() : std::nullopt) { throw_error_in(*file_, *fault); }
    }

private:
    /// As renderers give pictures, so that ffmpeg makes the same of them.
    static report::Picture with_alpha(report::Picture picture) {
        if (picture.channels == 4) { return picture; }
        report::Picture with{picture.width_px, picture.height_px, 4, {}};
        with.bytes.reserve(picture.bytes.size() / 3 * 4);
        for (std::size_t at = 0; at < picture.bytes.size(); at += 3) {
            with.bytes.insert(with.bytes.end(), picture.bytes.begin() + static_cast<std::ptrdiff_t>(at),
                picture.bytes.begin() + static_cast<std::ptrdiff_t>(at + 3));
            with.bytes.push_back(std::byte{255});
        }
        return with;
    }

    std::optional<fs::path> file_;
    std::optional<report::VideoPipe> pipe_;
};

void copy_into(const fs::path& from, const fs::path& to) {
    std::error_code code;
    fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::overwrite_existing, code);
    if (code) { throw_error_in(to, fmt::format("cannot be written: {}", code.message())); }
}

/// The recording of a whole flight while it is put together.
class PartMerger {
public:
    PartMerger(const SweepRun& whole, const fs::path& folder, const PartFile& first)
        : rate_hz_(first.run.value("rate_hz", 0.0)),
          picture_every_(whole.settings.time.pictures.value_or(std::max(1, static_cast<int>(std::lround(rate_hz_))))),
          recording_(folder, info_of(first)) {}

    /// The part's rows, and its pictures that the whole flight keeps.
    void add(const PartFile& part, PartVideo& video) {
        report::FrameReader rows(part.folder / "frames.csv");
        report::CounterReader counters(part.folder / report::counters_name);
        const double begun_s = last_ ? last_->wall_s + 1e-3 * last_->frame_ms : 0.0;
        bool is_seam = before_ != nullptr;
        while (auto row = rows.next()) {
            row->counters = counters.of(row->frame);
            if (std::exchange(is_seam, false)) {
                check_seam(*before_, last_, part, *row);
                continue;
            }
            row->wall_s += begun_s;
            add(part, *row, video);
        }
        before_ = &part;
        folders_.push_back(part.folder);
    }

    void finish(const PartFile& last) {
        const auto states = report::read_run_file(last.folder / "run.json").state_hash;
        recording_.finish({std::stoull(states, nullptr, 16), picture_hash_.value(), {}});
        copy_slow_pictures();
    }

private:
    static report::RunInfo info_of(const PartFile& first) {
        const report::RunFile run = report::read_run_file(first.folder / "run.json");
        report::RunInfo info;
        info.machine = run.machine_info;
        info.device = run.device;
        return info;
    }

    void add(const PartFile& part, const FrameRecord& row, PartVideo& video) {
        recording_.add(row);
        picture_hash_.add_word(row.picture_hash.value_or(0));
        last_ = row;
        const fs::path picture = recording_.picture_path(row.frame);
        const fs::path from = part.folder / picture.filename();
        if (picture_every_ > 0 && row.frame % picture_every_ == 0) { copy_into(from, picture); }
        slow_.add(row);
        video.add(from, rate_hz_);
    }

    /// Those of the whole flight's slowest frames: each is among the slowest of its part, even where the frame before
    /// the part is, too.
    void copy_slow_pictures() const {
        std::vector<report::SlowFrame> slowest = slow_.slowest();
        slowest.resize(std::min(slowest.size(), report::SlowPictures::max_shown));
        for (const report::SlowFrame& frame : slowest) {
            const std::string name = report::slow_picture_name(frame.record.frame);
            const auto part =
                std::ranges::find_if(folders_, [&](const fs::path& folder) { return is_file(folder / name); });
            if (picture_every_ > 0 && part != folders_.end()) { copy_into(*part / name, recording_.folder() / name); }
        }
    }

    double rate_hz_;
    int picture_every_;
    report::RecordingWriter recording_;
    Hash picture_hash_;
    std::optional<FrameRecord> last_;
    const PartFile* before_ = nullptr;
    std::vector<fs::path> folders_; // of the parts so far
    report::SlowFrameList slow_;
};

/// run.json of the whole: what the first part's says, with the summary that stands in `file`.
void write_run(const SweepRun& whole, const fs::path& folder, const std::vector<PartFile>& parts) {
    const fs::path file = folder / "run.json";
    Json run = parts.front().run;
    const Json merged = report::parsed_json(file, read_text_file(file));
    run["settings"] =
        settings::settings_json(world::settings_in_recording(world::with_absolute_paths(whole.settings), folder));
    run["summary"] = merged["summary"];
    std::string hosts;
    Json reasons = Json::array();
    for (const PartFile& part : parts) {
        hosts += (hosts.empty() ? "" : ", ") + part.host;
        for (const Json& reason : part.run["noise"]["reasons"]) {
            if (std::ranges::find(reasons, reason) == reasons.end()) { reasons.push_back(reason); }
        }
    }
    run["facts"]["flown in parts"] = fmt::format("{}, on {}", parts.size(), hosts);
    run["noise"] = {{"noisy", !reasons.empty()}, {"reasons", reasons}};
    write_file(file, run.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace

Sweep split_sweep(const Sweep& sweep, int count, bool for_videos) {
    Sweep parts;
    parts.name = sweep.name;
    for (const SweepRun& run : sweep.runs) {
        for (int number = 1; number <= count; ++number) {
            SweepRun part = run;
            part.name = fmt::format("{}.{}of{}", run.name, number, count);
            part.settings.time.part = fmt::format("{}/{}", number, count);
            if (for_videos) { part.settings.time.pictures = 1; }
            try {
                settings::check_settings(part.settings);
            } catch (const Error& fault) {
                throw Error(fmt::format("--split: {} cannot be divided: {}", run.name, fault.what()));
            }
            parts.runs.push_back(std::move(part));
        }
    }
    return parts;
}

void merge_parts(const SweepRun& whole, const fs::path& folder, const std::vector<fs::path>& part_folders,
    const std::optional<fs::path>& video_file) {
    std::vector<PartFile> parts;
    for (const fs::path& each : part_folders) {
        parts.push_back(part_in(each));
        check_same_flight(parts.front(), parts.back());
    }
    {
        PartMerger merger(whole, folder, parts.front());
        PartVideo video(video_file);
        for (const PartFile& part : parts) { merger.add(part, video); }
        video.finish();
        merger.finish(parts.back());
    }
    for (const char* track : {"track.csv", "track.acmi"}) { copy_into(parts.back().folder / track, folder / track); }
    std::error_code ignored;
    if (fs::exists(parts.back().folder / report::track_picture_name, ignored)) {
        copy_into(parts.back().folder / report::track_picture_name, folder / report::track_picture_name);
    }
    if (fs::is_directory(parts.front().folder / "inputs", ignored)) {
        copy_into(parts.front().folder / "inputs", folder / "inputs");
    }
    write_run(whole, folder, parts);
    flight::write_report(folder);
}

} // namespace octant::ui::sweep
