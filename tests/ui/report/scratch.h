#pragma once

#include "tests/scratch.h"
#include "ui/report/frame_record.h"
#include "ui/report/png_file.h"
#include "ui/report/recording_writer.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::report {

/// An empty folder of one test.
class ScratchFolder {
public:
    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_ = tests::empty_folder("report");
};

/// A run of two aircraft, with something in every field.
inline RunInfo made_up_info() {
    RunInfo info;
    info.title = "a flight";
    info.settings_json = R"({"path":"turn","aircraft":["f15","500md"],"rate":60,"nested":{"a":1}})";
    info.version = "0.1.0";
    info.commit = "abc1234";
    info.device = "some, renderer";
    info.path_offset_m = {0, 0, 412.5};
    info.machine.cpu = "cpu, fast";
    info.machine.cores = 2;
    info.machine.os = "system";
    info.machine.kernel = "kernel 1";
    info.machine.memory_kb = 1024;
    info.machine.cpu_times = {1000, 500, 10, 100};
    info.facts = {{"lowest height", "61 m"}};
    return info;
}

/// A frame with easily told numbers: sim 1, plan 2, draw `draw_ms`, read 0.5 ms.
inline FrameRecord made_up_frame(int frame, double draw_ms) {
    FrameRecord record;
    record.frame = frame;
    record.warm_up = frame < 2;
    record.sim_time_s = 0.05 * frame;
    record.wall_s = 0.02 * frame;
    record.sim_ms = 1.0;
    record.plan_ms = 2.0;
    record.draw_ms = draw_ms;
    record.read_ms = 0.5;
    record.frame_ms = 3.5 + draw_ms;
    record.terrain_triangles = 1000 + frame;
    record.triangle_change = frame > 0 ? 1 : 0;
    record.overrun = record.frame_ms > 16.67 ? 1 : 0;
    return record;
}

/// A picture in which every byte depends on its place.
inline Picture made_up_picture(int width_px, int height_px, int channels) {
    Picture picture{width_px, height_px, channels, {}};
    for (int i = 0; i < width_px * height_px * channels; ++i) {
        picture.bytes.push_back(static_cast<std::byte>((i * 37 + i / 7) & 255));
    }
    return picture;
}

/// Writes a finished recording of such frames.
inline Statistics record_frames(const std::filesystem::path& folder, const std::vector<FrameRecord>& frames,
    const RunSummary& end = {1, 2, {}}, const RunInfo& info = made_up_info()) {
    RecordingWriter recording(folder, info);
    for (const FrameRecord& frame : frames) { recording.add(frame); }
    return recording.finish(end);
}

/// Frames 0, 1, ... that draw for so long.
inline std::vector<FrameRecord> made_up_frames(int count, double draw_ms) {
    std::vector<FrameRecord> frames;
    for (int frame = 0; frame < count; ++frame) { frames.push_back(made_up_frame(frame, draw_ms)); }
    return frames;
}

} // namespace octant::ui::report
