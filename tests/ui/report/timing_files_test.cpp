#include "sim/base/text_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/kernel_counters.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/recording_writer.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sys/mman.h>

using namespace octant;
using namespace octant::ui::report;

TEST_CASE("the MangoHud log has its exact headers and leaves out the warm-up") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info());
    for (int frame = 0; frame < 3; ++frame) { recording.add(made_up_frame(frame, 4.5)); }
    recording.finish({});
    CHECK(read_file(scratch / "rec/mangohud.csv") ==
          "os,cpu,gpu,ram,kernel,driver,cpuscheduler\n"
          "system,cpu  fast,some  renderer,1024,kernel 1,,\n"
          "fps,frametime,cpu_load,cpu_power,gpu_load,cpu_temp,gpu_temp,gpu_core_clock,gpu_mem_clock,"
          "gpu_vram_used,gpu_power,ram_used,swap_used,process_rss,cpu_mhz,elapsed\n"
          "125.000,8.0000,0,0,0,0,0,0,0,0,0,0,0,0,0,48000000\n");
}

TEST_CASE("the trace holds every frame with its stages one after the other") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info());
    for (int frame = 0; frame < 3; ++frame) { recording.add(made_up_frame(frame, frame == 2 ? 14.5 : 4.5)); }
    recording.finish({});
    const auto trace = nlohmann::json::parse(read_file(scratch / "rec/trace.json"));
    std::map<std::string, std::vector<nlohmann::json>> events;
    for (const auto& event : trace) {
        events[event["ph"].get<std::string>() + " " + event["name"].get<std::string>()].push_back(event);
    }
    for (const char* name : {"X frame", "X sim", "X plan", "X draw", "X read"}) { CHECK(events[name].size() == 3); }
    CHECK(events["X plan"][1]["ts"] == 21000.0);
    CHECK(events["X draw"][1]["ts"] == 23000.0);
    CHECK(events["X draw"][1]["dur"] == 4500.0);
    CHECK(events["X frame"][1]["args"]["warm_up"] == true);
    CHECK(events["C terrain triangles"][2]["args"]["value"] == 1002);
    CHECK(events["C resolution C"].size() == 3);
    CHECK(events["i overrun"].size() == 1);
}

TEST_CASE("what the kernel counted stands beside the slowest frames") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info());
    for (int frame = 0; frame < 40; ++frame) {
        FrameRecord record = made_up_frame(frame, frame == 30 ? 50.0 : 5.0);
        record.counters = {100 + frame, frame, 10.0 * frame};
        recording.add(record);
    }
    recording.finish({1, 2, {}});
    const LoadedRecording loaded = load_recording(scratch / "rec");
    REQUIRE(loaded.has_counters);
    REQUIRE(loaded.slowest.size() == SlowFrameList::max_kept);
    CHECK(loaded.slowest[0].record.frame == 30);
    CHECK(loaded.slowest[0].record.counters.page_faults == 130);
    CHECK(loaded.slowest[0].record.counters.switches == 30);
    CHECK(loaded.slowest[0].record.counters.stolen_ms == 300.0);
    KernelCounters counters;
    counters.begin();
    constexpr std::size_t bytes = std::size_t{4} << 20;
    void* const fresh = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(fresh != MAP_FAILED);
    std::memset(fresh, 'x', bytes);
    CHECK(counters.lap().page_faults > 0);
    ::munmap(fresh, bytes);
}

TEST_CASE("the trace of a long flight ends with its slow frames") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info());
    for (int frame = 0; frame < 100'000; ++frame) { recording.add(made_up_frame(frame, frame == 99'999 ? 50.0 : 5.0)); }
    recording.finish({1, 2, {}});
    CHECK(std::filesystem::file_size(scratch / "rec/trace.json") < (std::size_t{50} << 20));
    const std::string trace = read_file(scratch / "rec/trace.json");
    CHECK(trace.find("\"frame\":1000,") != std::string::npos);
    CHECK(trace.find("\"frame\":99998,") == std::string::npos);
    CHECK(trace.find("\"frame\":99999,") != std::string::npos);
}
