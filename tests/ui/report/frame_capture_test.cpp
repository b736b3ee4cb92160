#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/comparison.h"
#include "ui/report/frame_capture.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::report;
using Catch::Contains;

namespace {

/// Reads a file that holds this text.
FrameCapture capture_of(const std::string& text, const std::string& name = "capture.csv") {
    const ScratchFolder scratch;
    write_file(scratch / name, text);
    return read_frame_capture(scratch / name);
}

std::vector<double> frame_times(const FrameCapture& capture) {
    std::vector<double> values;
    for (const FrameTime& frame : capture.frames) { values.push_back(frame.frame_ms); }
    return values;
}

std::vector<double> times(const FrameCapture& capture) {
    std::vector<double> values;
    for (const FrameTime& frame : capture.frames) { values.push_back(frame.time_s); }
    return values;
}

std::string notes(const FrameCapture& capture) {
    std::string text;
    for (const auto& [name, value] : capture.run.facts) { text += name == "note" ? value + "\n" : ""; }
    return text;
}

const std::string presentmon_1 = "Application,ProcessID,SwapChainAddress,Runtime,SyncInterval,PresentFlags,Dropped,"
                                 "TimeInSeconds,msInPresentAPI,msBetweenPresents\n";
const std::string mangohud = "os,cpu,gpu,ram,kernel,driver,cpuscheduler\nAn OS,A CPU,A GPU,1024,6.1,,none\n";

} // namespace

TEST_CASE("of a PresentMon file with several swap chains the one with the most frames is read") {
    const FrameCapture capture = capture_of(presentmon_1 + "dwm.exe,1,0x1,DXGI,0,0,0,1.00,0.1,16.5\n"
                                                           "game.exe,2,0x2,DXGI,0,0,0,1.01,0.1,0\n"
                                                           "game.exe,2,0x2,DXGI,0,0,1,1.02,0.1,10.0\n"
                                                           "game.exe,2,0x2,DXGI,0,0,0,1.04,0.1,20.0\n"
                                                           "game.exe,2,0x3,DXGI,0,0,0,1.04,0.1,21.0\n");
    CHECK(capture.format == "PresentMon CSV");
    CHECK(capture.run.title == "game.exe");
    CHECK(frame_times(capture) == std::vector{10.0, 20.0});
    CHECK(times(capture)[1] == Approx(0.02));
    CHECK_THAT(notes(capture),
        Contains("of 3 swap chains") && Contains("game.exe (2 frames); left out: dwm.exe (1), game.exe (1)"));
    CHECK_THAT(
        notes(capture), Contains("1 of 2 frames were dropped") && Contains("rows without a frame time, left out: 1"));
}

TEST_CASE("PresentMon 2 is read in all its headers: letter case, NA, frames of the driver") {
    const std::string first = "Application,ProcessID,SwapChainAddress,PresentRuntime,";
    const FrameCapture newest = capture_of("\xef\xbb\xbf" + first +
                                           "FrameType,TimeInMs,MSBETWEENPRESENTS,MsUntilDisplayed\r\n"
                                           "a.exe,1,0x1,DXGI,Application,1000,8.5,10\r\n"
                                           "a.exe,1,0x1,DXGI,AMD AFMF,1004,8.5,10\r\n"
                                           "a.exe,1,0x1,DXGI,Application,1008,8.0,NA\r\n"
                                           "a.exe,1,0x1,DXGI,Application,1016,NA,10\r\n");
    CHECK(frame_times(newest) == std::vector{8.5, 8.0});
    CHECK(times(newest)[1] == Approx(0.008));
    CHECK_THAT(notes(newest), Contains("1 of 2 frames were dropped") &&
                                  Contains("rows without a frame time, left out: 1") &&
                                  Contains("rows of frames that the driver generated, left out: 1"));
    const FrameCapture middle =
        capture_of(first + "CPUStartTime,FrameTime,CPUBusy,CPUWait\na.exe,1,0x1,DXGI,0,9,1,8\n");
    CHECK(frame_times(middle) == std::vector{9.0});
    const FrameCapture oldest = capture_of(first + "CPUStartTime,CPUBusy,CPUWait\na.exe,1,0x1,DXGI,0,2.5,7\n");
    CHECK(frame_times(oldest) == std::vector{9.5});
    CHECK(value_of(oldest.run.facts, "frame time is") == "CPUBusy + CPUWait");
}

TEST_CASE("semicolons, decimal commas and rows shorter than the names are read") {
    const FrameCapture capture = capture_of("Application;TimeInSeconds;MsBetweenPresents;Processor;GPU\n"
                                            "a.exe;0,5;16,25;A CPU;A GPU\n"
                                            "a.exe;0,52;20\n");
    CHECK(frame_times(capture) == std::vector{16.25, 20.0});
    CHECK(times(capture)[1] == Approx(0.02));
    CHECK(capture.run.machine_info.cpu == "A CPU");
    CHECK(capture.run.device == "A GPU");
}

TEST_CASE("the CSV of CapFrameX has its values in front") {
    const FrameCapture capture = capture_of("//GameName=A game\n//Processor=A CPU\n//GPU=A GPU\n//Comment=\n"
                                            "Application,Dropped,TimeInSeconds,MsBetweenPresents\n"
                                            ",0,0,4.5\n,0,0.005,5\n");
    CHECK(capture.format == "CapFrameX CSV");
    CHECK(capture.run.title == "A game");
    CHECK(value_of(capture.run.machine, "gpu") == "A GPU");
    CHECK(frame_times(capture) == std::vector{4.5, 5.0});
}

TEST_CASE("the JSON of CapFrameX is read with all its runs one after the other") {
    const FrameCapture capture = capture_of(
        R"({"Info":{"GameName":"A game","ProcessName":"a.exe","Processor":"A CPU","GPUCount":null},"Runs":[
        {"CaptureData":{"TimeInSeconds":[5.0,5.01],"MsBetweenPresents":[16.0,10],"Dropped":[false,true]}},
        {"CaptureData":{"TimeInSeconds":[0,0.02],"MsBetweenPresents":[30.0,20.0]}}]})",
        "anything");
    CHECK(capture.format == "CapFrameX JSON");
    CHECK(capture.run.title == "A game");
    CHECK(capture.run.machine_info.cpu == "A CPU");
    CHECK(frame_times(capture) == std::vector{16.0, 10.0, 30.0, 20.0});
    CHECK(times(capture)[2] == Approx(0.04));
    CHECK(times(capture)[3] == Approx(0.06));
    CHECK_THAT(notes(capture), Contains("2 runs") && Contains("1 of 4 frames were dropped"));
}

TEST_CASE("MangoHud logs are read with and without their version, in milliseconds or microseconds") {
    const FrameCapture plain = capture_of(mangohud + "fps,frametime,cpu_load,elapsed\n60,16.5,5,1000000000\n"
                                                     "50,20.0,5,1020000000\n",
        "my game.csv");
    CHECK(plain.format == "MangoHud log");
    CHECK(plain.run.title == "my game");
    CHECK(plain.run.machine_info.cpu == "A CPU");
    CHECK(plain.run.device == "A GPU");
    CHECK(frame_times(plain) == std::vector{16.5, 20.0});
    CHECK(times(plain)[1] == Approx(0.02));
    CHECK(notes(plain).empty());
    const FrameCapture versioned = capture_of(
        "v1\n0.7.1\n---SYSTEM INFO---\n" + mangohud + "---FRAME METRICS---\nfps,frametime\n60,16500\n50,20000\n");
    CHECK(frame_times(versioned) == std::vector{16.5, 20.0});
    CHECK(times(versioned)[1] == Approx(0.02));
    CHECK_THAT(notes(versioned), Contains("microseconds"));
}

TEST_CASE("a log of samples and impossible times are told in notes") {
    const FrameCapture sampled = capture_of("fps,frametime,elapsed\n100,10,0\n100,10,500000000\n100,10,1000000000\n");
    CHECK_THAT(notes(sampled), Contains("rows are 500.0 ms apart and frames take 10.0 ms"));
    const FrameCapture corrupt =
        capture_of("fps,frametime,elapsed\n100,10,0\n0.00001,99673900,10000000\n100,10,20000000\n");
    CHECK(frame_times(corrupt) == std::vector{10.0, 10.0});
    CHECK_THAT(notes(corrupt), Contains("frame times far longer than the capture, left out: 1"));
    const FrameCapture back = capture_of("fps,frametime,elapsed\n100,10,50000000\n100,10,0\n100,10,10000000\n");
    CHECK(times(back)[2] == Approx(0.02));
    CHECK_THAT(notes(back), Contains("the times of the frames go back"));
    const FrameCapture cut = capture_of("fps,frametime,elapsed\n100,10,0\n100,1");
    CHECK(frame_times(cut) == std::vector{10.0});
    CHECK_THAT(notes(cut), Contains("the last line is cut short"));
}

TEST_CASE("the MangoHud log of a recording has the frame times of the recording") {
    const ScratchFolder scratch;
    const Statistics statistics = record_frames(scratch / "rec", made_up_frames(6, 2.25));
    const LoadedRecording log = load_recording(scratch / "rec/mangohud.csv");
    CHECK(log.capture_format == "MangoHud log");
    CHECK(log.statistics == statistics);
    CHECK(log.run.machine_info.cpu == "cpu  fast");
}

TEST_CASE("what is no capture or is damaged is refused with its line") {
    const ScratchFolder scratch;
    const auto fault_of = [&](const std::string& text) {
        write_file(scratch / "f", text);
        try {
            read_frame_capture(scratch / "f");
            return std::string("none");
        } catch (const Error& fault) { return std::string(fault.what()).substr((scratch / "f").string().size()); }
    };
    const std::string columns = "fps,frametime\n";
    CHECK_THAT(fault_of(""), Contains(":1: expected a zip file of a recording, or frame times of PresentMon"));
    CHECK_THAT(fault_of("a,b\n1,2\n"), Contains("got 'a,b'"));
    CHECK_THAT(fault_of("{}"), Contains("got JSON without frame times in \"Runs\""));
    CHECK_THAT(fault_of("{\"Runs\":"), Contains(":1: expected JSON"));
    CHECK_THAT(fault_of(R"({"Runs":[{"CaptureData":{"MsBetweenPresents":[1,"x"]}}]})"),
        Contains("as element 1 of MsBetweenPresents, got '\"x\"'"));
    CHECK_THAT(fault_of(std::string("\xff\xfe"
                                    "f\0p\0",
                   6)),
        Contains("expected text in UTF-8, got UTF-16"));
    CHECK_THAT(fault_of(columns), Contains("expected a row with a frame time, got none"));
    CHECK_THAT(fault_of(columns + "60,16\n60,-1\n"), Contains(":3: expected a frame time of 0 to 1e9 ms, got '-1'"));
    CHECK_THAT(fault_of(columns + "60,1e99\n"), Contains(":2: expected a frame time"));
    CHECK_THAT(fault_of(columns + "60,fast\n"), Contains(":2: expected a frame time"));
    CHECK_THAT(fault_of(columns + "60\n60,16\n"), Contains(":2: expected 2 fields, got 1"));
    CHECK_THAT(fault_of(columns + "60,0,16,7\n"), Contains(":2: expected 2 fields, got 4"));
    CHECK_THAT(fault_of(columns + std::string(100'000, ',') + "\n"), Contains("expected at most 65535 bytes"));
}

TEST_CASE("a report on a capture shows no stages, hashes or simulated time") {
    const ScratchFolder scratch;
    write_file(
        scratch / "one.csv", presentmon_1 + "a<b>.exe,1,0x1,DXGI,0,0,0,0,0.1,16\na<b>.exe,1,0x1,DXGI,0,0,0,1,0.1,40\n");
    const std::vector<LoadedRecording> one{load_recording(scratch / "one.csv")};
    CHECK(one.front().statistics.frames == 2);
    const std::string page = html_report(one);
    CHECK_THAT(page, Contains("PresentMon CSV") && Contains("a&lt;b&gt;.exe"));
    for (const char* absent : {"Stages, stacked", "Terrain triangles", "state hash", "took most", "simulated time",
             "quiet machine", ", 0 cores"}) {
        CAPTURE(absent);
        CHECK_THAT(page, !Contains(absent));
    }
}

TEST_CASE("captures of other applications and recordings of Octant are not the same flight") {
    const ScratchFolder scratch;
    write_file(scratch / "a.csv", presentmon_1 + "a.exe,1,0x1,DXGI,0,0,0,0,0.1,16\n");
    write_file(scratch / "b.csv", presentmon_1 + "b.exe,1,0x1,DXGI,0,0,0,0,0.1,16\n");
    record_frames(scratch / "rec", made_up_frames(4, 2.0));
    const LoadedRecording a = load_recording(scratch / "a.csv");
    const SettingRoles roles = [](std::string_view) { return SettingRole::Scene; };
    CHECK(flight_differences(a, a, roles).empty());
    CHECK(flight_differences(a, load_recording(scratch / "b.csv"), roles) == std::vector<std::string>{"application"});
    const auto differ = flight_differences(a, load_recording(scratch / "rec"), roles);
    CHECK(std::ranges::count(differ, "application") == 1);
}

TEST_CASE("captures are compared by their figures, as their frames do not show the same") {
    const ScratchFolder scratch;
    std::vector<LoadedRecording> recordings;
    for (int run = 0; run < 6; ++run) {
        std::string text = presentmon_1;
        for (int frame = 0; frame < 50; ++frame) {
            text += fmt::format("a.exe,1,0x1,DXGI,0,0,0,{},0.1,{}\n", 0.02 * frame, (run < 3 ? 10 : 12) + 0.01 * run);
        }
        const auto file = scratch / fmt::format("{}.csv", run);
        write_file(file, text);
        recordings.push_back(load_recording(file));
    }
    const auto roles = [](std::string_view) { return SettingRole::Scene; };
    REQUIRE(compared_flights(recordings, roles).size() == 1);
    const FlightChange change = flight_change(recordings, {"old", {0, 1, 2}}, {"new", {3, 4, 5}}, roles);
    CHECK(change.frames.pairing == Pairing::Figures);
    CHECK(change.frames.old_ms == Approx(10.01));
    CHECK(change.frames.new_ms == Approx(12.04));
}
