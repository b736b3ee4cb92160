#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/frame_csv.h"
#include "ui/report/kernel_counters.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/packed_recording.h"
#include "ui/report/recording_writer.h"
#include "ui/report/statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace octant;
using namespace octant::ui::report;

namespace {

std::size_t lines_in(const std::filesystem::path& path) { return split_lines(read_file(path)).size(); }

/// Lets no file grow past `bytes`, as a full disk would.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }

    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    FileSizeLimit(FileSizeLimit&&) = delete;
    FileSizeLimit& operator=(FileSizeLimit&&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

} // namespace

TEST_CASE("run.json says at once what is flown, and at the end how it went") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info());
    const auto at_start = nlohmann::ordered_json::parse(read_file(scratch / "rec/run.json"));
    CHECK(at_start["settings"]["aircraft"][1] == "500md");
    CHECK(at_start["settings"].begin().key() == "path");
    CHECK(at_start["program"]["commit"] == "abc1234");
    CHECK(at_start["machine"]["cpu"] == "cpu, fast");
    CHECK(at_start["machine"]["gl_renderer"] == "some, renderer");
    CHECK(at_start["path_offset_m"] == nlohmann::ordered_json({0.0, 0.0, 412.5}));
    CHECK_FALSE(at_start.contains("summary"));
    for (int frame = 0; frame < 4; ++frame) { recording.add(made_up_frame(frame, 10.0 * frame)); }
    const Statistics statistics = recording.finish({0xabc, 0xfedcba9876543210U, {2000, 900, 30, 500}});
    CHECK(statistics.frames == 2);
    const auto at_end = nlohmann::ordered_json::parse(read_file(scratch / "rec/run.json"));
    CHECK(at_end["settings"] == at_start["settings"]);
    const auto& summary = at_end["summary"];
    std::vector<std::string> keys;
    for (const auto& [key, value] : summary.items()) { keys.push_back(key); }
    std::vector<std::string> expected;
    for (const Statistic& statistic : all_statistics()) { expected.emplace_back(statistic.key); }
    expected.insert(expected.end(), {"state_hash", "picture_hash"});
    CHECK(keys == expected);
    CHECK(summary["frames"] == 2);
    CHECK(summary["mean_ms"] == 28.5);
    CHECK(summary["overruns_16ms"].dump() == "2");
    CHECK(summary["state_hash"] == "0000000000000abc");
    CHECK(summary["picture_hash"] == "fedcba9876543210");
    CHECK(at_end["noise"]["noisy"] == true);
    CHECK(at_end["noise"]["steal_share"] == 0.02);
}

TEST_CASE("frames reach the file every so many and every half second") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info(), 3);
    const auto frames = scratch / "rec/frames.csv";
    CHECK(lines_in(frames) == 1);
    recording.add(made_up_frame(0, 1));
    recording.add(made_up_frame(1, 1));
    CHECK(lines_in(frames) == 1);
    recording.add(made_up_frame(2, 1));
    CHECK(lines_in(frames) == 4);
    FrameRecord late = made_up_frame(3, 1);
    late.wall_s = 0.54;
    recording.add(late);
    CHECK(lines_in(frames) == 5);
}

TEST_CASE("a folder with other things in it is refused and left alone") {
    const ScratchFolder scratch;
    make_folder(scratch / "home");
    write_file(scratch / "home/letter.txt", "dear");
    const std::string home = (scratch / "home").string();
    CHECK_THROWS_WITH(RecordingWriter(home, made_up_info()),
        home + ": expected an empty folder or a recording to replace, got one with 'letter.txt'");
    write_file(scratch / "home/run.json", "{\"summary\": {}}");
    CHECK_THROWS_AS(RecordingWriter(home, made_up_info()), Error);
    CHECK(read_file(scratch / "home/letter.txt") == "dear");
    CHECK(read_file(scratch / "home/run.json") == "{\"summary\": {}}");
    const std::string file = home + "/letter.txt";
    CHECK_THROWS_AS(RecordingWriter(file, made_up_info()), Error);
}

TEST_CASE("nobody records into a folder that is being recorded into, and a killed one's is free") {
    const ScratchFolder scratch;
    const std::string folder = (scratch / "rec").string();
    {
        RecordingWriter recording(folder, made_up_info());
        recording.add(made_up_frame(0, 1));
        CHECK_THROWS_WITH(RecordingWriter(folder, made_up_info()),
            Catch::StartsWith(folder + ": expected a folder that nobody records into, got one that process " +
                              std::to_string(getpid())));
        recording.finish({});
        CHECK(load_recording(folder).flight.frames() == 1);
    }
    CHECK_FALSE(std::filesystem::exists(scratch / "rec/recording.lock"));
    write_file(scratch / "rec/recording.lock", "process 1 on a machine that was switched off\n");
    CHECK_NOTHROW(RecordingWriter(folder, made_up_info()));
}

TEST_CASE("a summary of other rows and a lost row of the warm-up are reported") {
    const ScratchFolder scratch;
    const std::string stopped = "SIGINT after 6 of 9 frames";
    record_frames(scratch / "rec", made_up_frames(6, 10.0), {1, 2, {}, {}, stopped});
    CHECK(load_recording(scratch / "rec").disagreement.empty());
    CHECK(load_recording(scratch / "rec").run.stopped == stopped);
    const auto disagreement = [&](const std::vector<int>& numbers) {
        std::string rows = frame_csv_header();
        for (const int frame : numbers) { rows += frame_csv_line(made_up_frame(frame, 10.0)); }
        write_file(scratch / "rec/frames.csv", rows);
        return load_recording(scratch / "rec").disagreement;
    };
    CHECK(disagreement({0, 1, 2, 3}) == "frames: 4 in run.json, 2 by the rows");
    CHECK(disagreement({0, 2, 3, 4, 5}) == "line 3 of frames.csv: expected frame 1, got 2");
}

TEST_CASE("an older recording gives way with all its files and nothing else") {
    const ScratchFolder scratch;
    {
        RecordingWriter recording(scratch / "rec", made_up_info());
        recording.add(made_up_frame(0, 1));
        recording.add_picture(7, made_up_picture(2, 2, 3).view());
        recording.finish({});
    }
    write_file(scratch / "rec/notes.txt", "mine");
    write_file(scratch / "rec/track.acmi", "old");
    const RecordingWriter recording(scratch / "rec", made_up_info());
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scratch / "rec")) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    CHECK(names == std::vector<std::string>{"counters.csv", "frames.csv", "mangohud.csv", "notes.txt", "recording.lock",
                       "run.json", "trace.json"});
}

TEST_CASE("a full disk gives one error and leaves a recording that loads") {
    const ScratchFolder scratch;
    {
        RecordingWriter recording(scratch / "rec", made_up_info(), 1);
        const FileSizeLimit limit(8000);
        const auto fly = [&] {
            for (int frame = 0; frame < 100; ++frame) { recording.add(made_up_frame(frame, 1)); }
        };
        CHECK_THROWS_WITH(fly(), (scratch / "rec/trace.json").string() + ": cannot be written: File too large");
    }
    const LoadedRecording loaded = load_recording(scratch / "rec");
    CHECK(loaded.ended_early);
    CHECK(loaded.flight.frames() > 5);
    CHECK(nlohmann::json::parse(read_file(scratch / "rec/trace.json")).size() > 5);
}

TEST_CASE("a killed recording loads with the figures of what is left") {
    const ScratchFolder scratch;
    {
        RecordingWriter recording(scratch / "rec", made_up_info(), 1);
        for (int frame = 0; frame < 6; ++frame) { recording.add(made_up_frame(frame, 10.0)); }
        recording.add_picture(4, made_up_picture(2, 2, 3).view());
        recording.add_picture(10, made_up_picture(2, 2, 3).view());
    }
    const auto frames = scratch / "rec/frames.csv";
    write_file(frames, read_file(frames) + "6,0.3,0.");
    const LoadedRecording loaded = load_recording(scratch / "rec/");
    CHECK(loaded.name == "rec");
    CHECK(loaded.ended_early);
    CHECK(loaded.statistics.frames == 4);
    CHECK(loaded.statistics.mean_ms == 13.5);
    CHECK(loaded.run.title == "a flight");
    CHECK(loaded.run.state_hash.empty());
    REQUIRE(loaded.pictures.size() == 2);
    CHECK(loaded.pictures[1].filename() == "picture-00010.png");
    CHECK(loaded.run.settings[1] == std::pair<std::string, std::string>("aircraft", "f15, 500md"));
    CHECK(loaded.run.settings[3] == std::pair<std::string, std::string>("nested.a", "1"));
    CHECK(lines_in(scratch / "rec/mangohud.csv") == 3 + 4);
    CHECK(nlohmann::json::parse(read_file(scratch / "rec/trace.json")).size() > 6 * 5);
}

TEST_CASE("whenever a recording is killed its trace is JSON and its logs have whole lines") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info(), 3);
    for (int frame = 0; frame < 12; ++frame) {
        const auto trace = nlohmann::json::parse(read_file(scratch / "rec/trace.json"));
        const auto frames = std::ranges::count_if(trace, [](const auto& event) { return event["name"] == "frame"; });
        CHECK(frames == frame / 3 * 3);
        CHECK(lines_in(scratch / "rec/mangohud.csv") == static_cast<std::size_t>(3 + std::max(0, frame / 3 * 3 - 2)));
        for (const char* name : {"mangohud.csv", "frames.csv", "counters.csv"}) {
            CHECK(read_file(scratch / "rec" / name).ends_with('\n'));
        }
        recording.add(made_up_frame(frame, 10.0));
    }
}

TEST_CASE("the figures read back are those of the summary bit for bit") {
    const ScratchFolder scratch;
    std::vector<FrameRecord> frames;
    for (int frame = 0; frame < 200; ++frame) { frames.push_back(made_up_frame(frame, 3.0 + 1.0 / (1.0 + frame % 7))); }
    const Statistics at_end = record_frames(scratch / "rec", frames);
    const LoadedRecording loaded = load_recording(scratch / "rec");
    CHECK(loaded.statistics == at_end);
    CHECK_FALSE(loaded.ended_early);
    CHECK(loaded.run.picture_hash == "0000000000000002");
}

TEST_CASE("what is no recording is refused by name") {
    const ScratchFolder scratch;
    const std::string folder = scratch.path().string();
    CHECK_THROWS_WITH(
        load_recording(folder + "/none"), folder + "/none: expected the folder of a recording, found none");
    CHECK_THROWS_WITH(load_recording(folder), folder + "/run.json: expected a file, found none");
    write_file(folder + "/run.json", "{\"a\":");
    CHECK_THROWS_WITH(
        load_recording(folder), folder + "/run.json:1: expected JSON, got something else or a part of it");
    write_file(folder + "/run.json", "[]");
    CHECK_THROWS_WITH(
        load_recording(folder), folder + "/run.json: expected \"format\": \"octant recording\", got none");
}

TEST_CASE("a recording of a newer program is refused and never replaced") {
    const ScratchFolder scratch;
    record_frames(scratch / "rec", made_up_frames(3, 4.5));
    const auto file = scratch / "rec/run.json";
    const std::string text = read_file(file);
    const std::string ours = "\"format_version\": 1,";
    REQUIRE(text.find(ours) != std::string::npos);
    const auto with_version = [&](const std::string& version) {
        std::string other = text;
        write_file(file, other.replace(text.find(ours), ours.size(), version));
    };
    for (const auto& [version, told] : std::map<std::string, std::string>{{"99", "99: a newer Octant wrote it"},
             {"2", "2: a newer Octant wrote it"}, {"1.5", "1.5: a newer Octant wrote it"},
             {"18446744073709551615", "18446744073709551615: a newer Octant wrote it"}, {"0.5", "0.5"}, {"\"1\"", "1"},
             {"[1]", "1"}, {"true", "true"}}) {
        with_version("\"format_version\": " + version + ",");
        const std::string refused = file.string() + ": expected format_version 1 or earlier, got " + told;
        CHECK_THROWS_WITH(load_recording(scratch / "rec"), refused);
        CHECK_THROWS_WITH(is_run_file(file), refused);
        CHECK_THROWS_WITH(pack_recording(scratch / "rec", scratch / "rec.zip", false), refused);
        CHECK_THROWS_WITH(RecordingWriter(scratch / "rec", made_up_info()), refused);
        CHECK(std::filesystem::exists(scratch / "rec/frames.csv"));
    }
    for (const std::string version : {"", "\"format_version\": 0,"}) {
        with_version(version);
        CHECK(load_recording(scratch / "rec").flight.frames() == 3);
    }
}

TEST_CASE("numbers of a machine that no machine has count as not told") {
    const ScratchFolder scratch;
    const auto file = scratch / "run.json";
    for (const std::string number : {"1e308", "-4", "1e19", "\"many\"", "null"}) {
        write_file(file, R"({"format": "octant recording", "machine": {"cores": )" + number + R"(, "memory_kb": )" +
                             number + R"(, "load_average_1min": )" + number + "}}");
        const RunFile run = read_run_file(file);
        CHECK(run.machine_info.cores == 0);
        CHECK(run.machine_info.memory_kb == 0);
        CHECK(run.machine_info.load_average_1min == 0.0);
    }
}

TEST_CASE("the MangoHud log has its exact headers and leaves out the warm-up") {
    const ScratchFolder scratch;
    record_frames(scratch / "rec", made_up_frames(3, 4.5));
    CHECK(read_file(scratch / "rec/mangohud.csv") ==
          "os,cpu,gpu,ram,kernel,driver,cpuscheduler\n"
          "system,cpu  fast,some  renderer,1024,kernel 1,,\n"
          "fps,frametime,cpu_load,cpu_power,gpu_load,cpu_temp,gpu_temp,gpu_core_clock,gpu_mem_clock,"
          "gpu_vram_used,gpu_power,ram_used,swap_used,process_rss,cpu_mhz,elapsed\n"
          "125.000,8.0000,0,0,0,0,0,0,0,0,0,0,0,0,0,48000000\n");
}

TEST_CASE("frames in which the program was stopped are told in a note and count in no figure") {
    const ScratchFolder scratch;
    RecordingWriter recording(scratch / "rec", made_up_info());
    for (int frame = 0; frame < 10; ++frame) {
        FrameRecord record = made_up_frame(frame, frame == 5 ? 90.0 : 4.5);
        record.paused = frame == 5 || frame == 0;
        recording.add(record);
    }
    recording.finish({0xabc, {}, {2000, 900, 30, 500}});
    const LoadedRecording loaded = load_recording(scratch / "rec");
    CHECK(loaded.statistics.frames == 7);
    CHECK(loaded.statistics.max_ms == 8.0);
    CHECK(loaded.disagreement.empty());
    CHECK(loaded.flight.paused_frames() == 1);
    CHECK(loaded.flight.frames() == 10);
    CHECK(lines_in(scratch / "rec/mangohud.csv") == 3 + 7);
    CHECK(value_of(loaded.run.facts, "note") == pauses_note(1));
}

TEST_CASE("the trace holds every frame with its stages one after the other") {
    const ScratchFolder scratch;
    record_frames(scratch / "rec", {made_up_frame(0, 4.5), made_up_frame(1, 4.5), made_up_frame(2, 14.5)});
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
    std::vector<FrameRecord> frames;
    for (int frame = 0; frame < 40; ++frame) {
        frames.push_back(made_up_frame(frame, frame == 30 ? 50.0 : 5.0));
        frames.back().counters = {100 + frame, frame, 10.0 * frame};
    }
    record_frames(scratch / "rec", frames);
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
    std::vector<FrameRecord> frames = made_up_frames(85'000, 5.0);
    frames.back() = made_up_frame(84'999, 50.0);
    record_frames(scratch / "rec", frames);
    CHECK(std::filesystem::file_size(scratch / "rec/trace.json") < (std::size_t{50} << 20));
    const std::string trace = read_file(scratch / "rec/trace.json");
    CHECK(trace.find("\"frame\":1000,") != std::string::npos);
    CHECK(trace.find("\"frame\":84998,") == std::string::npos);
    CHECK(trace.find("\"frame\":84999,") != std::string::npos);
}
