#include "ui/report/recording_writer.h"

#include "sim/base/error.h"
#include "ui/report/folder_lock.h"
#include "ui/report/frame_csv.h"
#include "ui/report/frame_record.h"
#include "ui/report/kernel_counters.h"
#include "ui/report/machine_info.h"
#include "ui/report/png_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

/// A field of a CSV file whose readers know no quotes.
std::string plain_field(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20; },
        ' ');
    return text;
}

// A trace for Perfetto and chrome://tracing: a list of events (Trace Event Format, "JSON Array Format"), times in
// microseconds. The list is closed at each flush, as parsers of JSON refuse one without its end.

void append_duration(std::string& text, const char* name, double start_us, double duration_us) {
    text += fmt::format(",\n{{\"name\":\"{}\",\"ph\":\"X\",\"ts\":{:.3f},\"dur\":{:.3f},\"pid\":1,\"tid\":1", name,
        start_us, duration_us);
}

void append_counter(std::string& text, const char* name, double at_us, double value) {
    if (std::isfinite(value)) {
        text += fmt::format(",\n{{\"name\":\"{}\",\"ph\":\"C\",\"ts\":{:.3f},\"pid\":1,\"args\":{{\"value\":{}}}}}",
            name, at_us, value);
    }
}

constexpr std::string_view trace_head = "[\n"
                                        "{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":1,\"tid\":1,"
                                        "\"args\":{\"name\":\"octant\"}},\n"
                                        "{\"name\":\"thread_name\",\"ph\":\"M\",\"pid\":1,\"tid\":1,"
                                        "\"args\":{\"name\":\"frames\"}}";
constexpr std::string_view trace_end = "\n]\n";

/// A frame as an "X" event with its stages inside it, one after the other; counters for triangles and resolution; an
/// instant event at an overrun.
std::string trace_events(const FrameRecord& record) {
    std::string text;
    const double start_us = 1e6 * record.wall_s;
    append_duration(text, "frame", start_us, 1e3 * record.frame_ms);
    text += fmt::format(",\"args\":{{\"frame\":{},\"sim_time_s\":{},\"warm_up\":{},\"draw_cell\":{}}}}}", record.frame,
        record.sim_time_s, record.warm_up, record.draw_cell);
    double stage_us = start_us;
    for (const auto& [name, stage_ms] : {std::pair("sim", record.sim_ms), std::pair("plan", record.plan_ms),
             std::pair("draw", record.draw_ms), std::pair("read", record.read_ms)}) {
        append_duration(text, name, stage_us, 1e3 * stage_ms);
        text += "}";
        stage_us += 1e3 * stage_ms;
    }
    append_counter(text, "terrain triangles", start_us, record.terrain_triangles);
    append_counter(text, "resolution C", start_us, record.resolution_c);
    if (record.overrun != 0) {
        text += fmt::format(",\n{{\"name\":\"overrun\",\"ph\":\"i\",\"s\":\"t\",\"ts\":{:.3f},\"pid\":1,\"tid\":1}}",
            start_us + 1e3 * record.frame_ms);
    }
    return text;
}

/// The head of a MangoHud log, in its plain CSV without the "v1" lines.
std::string mangohud_head(const MachineInfo& machine, const std::string& renderer) {
    return fmt::format("os,cpu,gpu,ram,kernel,driver,cpuscheduler\n{},{},{},{},{},,\n"
                       "fps,frametime,cpu_load,cpu_power,gpu_load,cpu_temp,gpu_temp,gpu_core_clock,"
                       "gpu_mem_clock,gpu_vram_used,gpu_power,ram_used,swap_used,process_rss,cpu_mhz,elapsed\n",
        plain_field(machine.os), plain_field(machine.cpu), plain_field(renderer), machine.memory_kb,
        plain_field(machine.kernel));
}

/// A frame's line; nothing for one that does not count, so that MangoHud's tools and ours count the same frames.
/// `elapsed` (ns) is the end of the frame; what MangoHud measures and we do not is 0.
std::string mangohud_line(const FrameRecord& record) {
    if (!record.is_counted()) { return {}; }
    const double fps = record.frame_ms > 0.0 ? 1000.0 / record.frame_ms : 0.0;
    return fmt::format("{:.3f},{:.4f},0,0,0,0,0,0,0,0,0,0,0,0,0,{:.0f}\n", fps, record.frame_ms,
        1e9 * record.wall_s + 1e6 * record.frame_ms);
}

namespace fs = std::filesystem;

/// The folder's entries; throws Error when it cannot be read.
std::vector<fs::path> entries_of(const fs::path& folder) {
    std::error_code code;
    std::vector<fs::path> entries;
    for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        entries.push_back(at->path());
    }
    if (code) { throw_error_in(folder, fmt::format("cannot be read: {}", code.message())); }
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
        throw_error_in(folder, fmt::format("expected an empty folder or a recording to replace, got one with '{}'",
                                   printable(foreign->filename().string())));
    }
    for (const fs::path& entry : entries) {
        const std::string name = entry.filename().string();
        std::error_code code;
        if (name == lock_name || !is_recording_name(name)) { continue; }
        fs::remove_all(entry, code);
        if (code) { throw_error_in(entry, fmt::format("cannot be removed: {}", code.message())); }
    }
}

/// run.json before frames.csv: where there are frames there is a run.json that says whose. The copies of what the run
/// reads are written and forgotten.
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
    : folder_(create_folder(std::move(folder))), lock_(folder_), info_(std::move(info)),
      flush_every_frames_(flush_every_frames), frames_file_(begin_recording(folder_, info_)),
      mangohud_file_(folder_ / "mangohud.csv"), trace_file_(folder_ / "trace.json", std::string(trace_end)),
      counters_file_(folder_ / counters_name) {
    assert(flush_every_frames >= 1);
    frames_file_.append(frame_csv_header());
    mangohud_file_.append(mangohud_head(info_.machine, info_.device));
    trace_file_.append(trace_head);
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
    paused_frames_ += record.paused && !record.warm_up ? 1 : 0;
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

fs::path RecordingWriter::picture_path(int frame) const { return folder_ / fmt::format("picture-{:05}.png", frame); }

void RecordingWriter::add_picture(int frame, const PixelView& picture) const {
    write_png(picture_path(frame), picture);
}

void RecordingWriter::set_settings(std::string settings_json) {
    info_.settings_json = std::move(settings_json);
    write_file(folder_ / "run.json", run_json(info_));
}

Statistics RecordingWriter::finish(const RunSummary& summary) {
    frames_file_.flush();
    const Statistics statistics = times_.statistics();
    RunSummary end = summary;
    if (paused_frames_ > 0) { end.notes.push_back(pauses_note(paused_frames_)); }
    write_file(folder_ / "run.json", run_json(info_, end, statistics));
    flush();
    return statistics;
}

} // namespace octant::ui::report
