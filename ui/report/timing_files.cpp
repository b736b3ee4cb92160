#include "ui/report/timing_files.h"

#include "sim/base/format_once.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace octant::ui::report {

namespace {

/// A field of a CSV file whose readers know no quotes.
std::string plain_field(std::string text) {
    std::replace_if(
        text.begin(),
        text.end(),
        [](char c) { return c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20; },
        ' ');
    return text;
}

struct Stage {
    const char* name;
    double FrameRecord::*duration_ms;
};

constexpr std::array stages{
    Stage{"sim", &FrameRecord::sim_ms},
    Stage{"plan", &FrameRecord::plan_ms},
    Stage{"draw", &FrameRecord::draw_ms},
    Stage{"read", &FrameRecord::read_ms},
};

using Out = std::back_insert_iterator<std::string>;

void append_duration(Out out, const char* name, double start_us, double duration_us) {
    fmt::format_to(
        out,
        ",\n{{\"name\":\"{}\",\"ph\":\"X\",\"ts\":{:.3f},\"dur\":{:.3f},\"pid\":1,\"tid\":1",
        name,
        start_us,
        duration_us);
}

void append_counter(Out out, const char* name, double at_us, double value) {
    if (std::isfinite(value)) {
        fmt::format_to(
            out,
            ",\n{{\"name\":\"{}\",\"ph\":\"C\",\"ts\":{:.3f},\"pid\":1,\"args\":{{\"value\":{}}}}}",
            name,
            at_us,
            value);
    }
}

void append_frame(Out out, const FrameRecord& record) {
    const double start_us = 1e6 * record.wall_s;
    append_duration(out, "frame", start_us, 1e3 * record.frame_ms);
    fmt::format_to(
        out,
        ",\"args\":{{\"frame\":{},\"sim_time_s\":{},\"warm_up\":{},\"draw_cell\":{}}}}}",
        record.frame,
        record.sim_time_s,
        record.warm_up,
        record.draw_cell);
    double stage_us = start_us;
    for (const Stage& stage : stages) {
        const double duration_us = 1e3 * (record.*stage.duration_ms);
        append_duration(out, stage.name, stage_us, duration_us);
        fmt::format_to(out, "}}");
        stage_us += duration_us;
    }
    append_counter(out, "terrain triangles", start_us, record.terrain_triangles);
    append_counter(out, "resolution C", start_us, record.resolution_c);
    if (record.overrun != 0) {
        fmt::format_to(
            out,
            ",\n{{\"name\":\"overrun\",\"ph\":\"i\",\"s\":\"t\",\"ts\":{:.3f},\"pid\":1,\"tid\":1}"
            "}",
            start_us + 1e3 * record.frame_ms);
    }
}

} // namespace

std::string mangohud_head(const MachineInfo& machine, const std::string& renderer) {
    return fmt::format(
        "os,cpu,gpu,ram,kernel,driver,cpuscheduler\n{},{},{},{},{},,\n"
        "fps,frametime,cpu_load,cpu_power,gpu_load,cpu_temp,gpu_temp,gpu_core_clock,"
        "gpu_mem_clock,gpu_vram_used,gpu_power,ram_used,swap_used,process_rss,cpu_mhz,elapsed\n",
        plain_field(machine.os),
        plain_field(machine.cpu),
        plain_field(renderer),
        machine.memory_kb,
        plain_field(machine.kernel));
}

std::string mangohud_line(const FrameRecord& record) {
    if (record.warm_up) {
        return {};
    }
    const double fps = record.frame_ms > 0.0 ? 1000.0 / record.frame_ms : 0.0;
    return fmt::format(
        "{:.3f},{:.4f},0,0,0,0,0,0,0,0,0,0,0,0,0,{:.0f}\n",
        fps,
        record.frame_ms,
        1e9 * record.wall_s + 1e6 * record.frame_ms);
}

std::string trace_head() {
    return "[\n"
           "{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":1,\"tid\":1,"
           "\"args\":{\"name\":\"octant\"}},\n"
           "{\"name\":\"thread_name\",\"ph\":\"M\",\"pid\":1,\"tid\":1,"
           "\"args\":{\"name\":\"frames\"}}";
}

std::string trace_events(const FrameRecord& record) {
    std::string text;
    append_frame(std::back_inserter(text), record);
    return text;
}

std::string trace_end() {
    return "\n]\n";
}

} // namespace octant::ui::report
