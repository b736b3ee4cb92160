#include "flightpaths/recorded_track.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/report/folder_lock.h"
#include "ui/report/loaded_recording.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

using namespace octant;

namespace {

namespace fs = std::filesystem;

/// A flight in real time, 30 pictures a second, all of them kept.
std::vector<std::string> slow_flight(const fs::path& folder) {
    return {"fly", "straight", "--terrain", tests::small_ground(), "--realtime", "--rate", "30", "--size", "160x90",
        "--triangles", "2000", "--pictures", "1", "--record", folder.string()};
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        files[entry.path().filename().string()] = read_file(entry.path());
    }
    return files;
}

const std::vector<std::pair<int, std::string>> stop_signals{
    {SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}};

double last_time_in_track(const fs::path& folder) {
    const std::string text = read_file(folder / "track.csv");
    const auto lines = split_lines(text);
    return finite_number(lines.back().substr(0, lines.back().find(','))).value();
}

} // namespace

TEST_CASE("a flight that was killed is reported, losing at most its last second") {
    const auto folder = tests::empty_folder("killed") / "out";
    CHECK(tests::run_octant_and_signal(slow_flight(folder), folder / "picture-00100.png", SIGKILL).exit_code ==
          128 + SIGKILL);
    const auto left = files_in(folder);
    const auto page = folder.parent_path() / "elsewhere.html";
    const tests::ProgramRun run = tests::run_octant({"report", folder.string(), "--out", page.string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.err.find("ended early") != std::string::npos);
    CHECK(fs::exists(page));
    CHECK(files_in(folder) == left);
    CHECK(nlohmann::json::parse(left.at("trace.json")).size() > 30 * 5);
    CHECK(left.at("mangohud.csv").ends_with('\n'));
    const std::string rows = left.at("mangohud.csv").substr(left.at("mangohud.csv").find("fps,"));
    for (const std::string_view line : split_lines(rows)) { CHECK(std::ranges::count(line, ',') == 15); }
    CHECK(left.at("track.acmi").ends_with('\n'));
    CHECK(flightpaths::parse_track_recording(left.at("track.acmi"), folder / "track.acmi").aircraft.size() == 1);
    const auto loaded = ui::report::load_recording(folder);
    REQUIRE(loaded.ended_early);
    REQUIRE(loaded.flight.frames() > 30);
    // In real time the last picture written tells how far the flight had come.
    const double flown_s = std::stod(loaded.pictures.back().stem().string().substr(8)) / 30.0;
    CHECK(loaded.flight.end_s() > flown_s - 1.0);
    CHECK(last_time_in_track(folder) < flown_s + 0.1);
    CHECK(last_time_in_track(folder) > flown_s - 1.5);
}

TEST_CASE("a flight that ended and whose rows were cut off is reported with exit code 1") {
    const auto made = tests::empty_folder("cut-rows");
    const auto folder = made / "out";
    const tests::ProgramRun flown = tests::run_octant({"fly", "straight", "--size", "64x48", "--terrain",
        tests::small_ground(), "--frames", "6", "--warm-up", "2", "--record", folder.string(), "--quiet"});
    REQUIRE(flown.exit_code == 0);
    const std::string rows = read_file(folder / "frames.csv");
    const auto report = [&](const std::string& left) {
        write_file(folder / "frames.csv", left);
        return tests::run_octant({"report", folder.string(), "--quiet", "--json"});
    };
    CHECK(report(rows).exit_code == 0);
    const std::size_t last_row = rows.rfind('\n', rows.size() - 2) + 1;
    for (const std::size_t left : {last_row, (last_row + rows.size()) / 2, rows.size() - 1}) {
        fs::remove(folder / "report.html");
        const tests::ProgramRun cut = report(rows.substr(0, left));
        INFO(left << cut.err);
        CHECK(cut.exit_code == 1);
        CHECK(cut.out.find("frames: 4 in run.json, 3 by the rows") != std::string::npos);
        CHECK(read_file(folder / "report.html").find("rows and summary disagree") != std::string::npos);
    }
    const tests::ProgramRun quiet = tests::run_octant({"report", folder.string(), "--quiet"});
    CHECK(quiet.exit_code == 1);
    CHECK(quiet.out.find("summary and rows disagree") != std::string::npos);
    // A killed flight has no summary: a half-written last row is what it leaves.
    std::string run = read_file(folder / "run.json");
    const std::size_t summary = run.find("\"summary\"");
    REQUIRE(summary != std::string::npos);
    run.replace(summary, 9, "\"was-summary\"");
    write_file(folder / "run.json", run);
    CHECK(report(rows.substr(0, (last_row + rows.size()) / 2)).exit_code == 0);
}

TEST_CASE("a signal ends a flight in order, and its recording can be flown again") {
    const auto made = tests::empty_folder("stopped");
    auto folder = made / "none";
    for (const auto& [number, name] : stop_signals) {
        INFO(name);
        folder = made / name;
        const tests::ProgramRun run =
            tests::run_octant_and_signal(slow_flight(folder), folder / "picture-00040.png", number);
        INFO(run.err);
        CHECK(run.exit_code == 128 + number);
        CHECK(run.out.find("state hash") != std::string::npos);
        const auto loaded = ui::report::load_recording(folder);
        CHECK_FALSE(loaded.ended_early);
        CHECK(loaded.disagreement.empty());
        CHECK(loaded.run.stopped.starts_with(name + " after "));
        CHECK(loaded.flight.frames() >= 41);
        CHECK(last_time_in_track(folder) <= loaded.flight.end_s() + 1e-6);
        CHECK(fs::exists(folder / "report.html"));
        CHECK_FALSE(fs::exists(folder / "recording.lock"));
    }
    const tests::ProgramRun repeat_option = tests::run_octant({"fly", "--replay", folder.string()});
    INFO(repeat_option.out << repeat_option.err);
    CHECK(repeat_option.exit_code == 0);
    CHECK(repeat_option.out.find("same states, same pictures") != std::string::npos);
}

TEST_CASE("a signal ends a live flight as any other: summary, report, no lock, its exit code") {
    const auto made = tests::empty_folder("listen-stopped");
    for (const auto& [number, name] : stop_signals) {
        INFO(name);
        const auto folder = made / name;
        const tests::ProgramRun run = tests::run_octant_and_signal(
            {"listen", "--headless", "--size", "64x48", "--ports", "fdm=0,dis=-1,mavlink=-1,xplane=-1,cigi=-1",
                "--terrain", tests::small_ground(), "--seconds", "60", "--pictures", "1", "--record", folder.string()},
            folder / "picture-00020.png", number);
        INFO(run.err);
        CHECK(run.exit_code == 128 + number);
        CHECK(run.out.find("state hash") != std::string::npos);
        CHECK(run.err.find("ended by " + name) != std::string::npos);
        CHECK_FALSE(ui::report::load_recording(folder).ended_early);
        CHECK(fs::exists(folder / "report.html"));
        CHECK_FALSE(fs::exists(folder / "recording.lock"));
    }
}

TEST_CASE("a signal ends a sweep in order, with what is flown so far") {
    const auto made = tests::empty_folder("sweep-stopped");
    write_file(made / "long.toml",
        "name = \"long\"\n[settings]\npath = \"straight\"\nterrain = \"none\"\nsize = \"48x32\"\n"
        "realtime = true\nseconds = 60\n[vary]\nfov = [40, 50, 60]\n");
    for (const auto& [number, name] : stop_signals) {
        INFO(name);
        const auto folder = made / name;
        // The last of the file is the first in the order of flying.
        const tests::ProgramRun run =
            tests::run_octant_and_signal({"sweep", (made / "long.toml").string(), "--out", folder.string(), "--quiet"},
                folder / "runs/60/picture-00000.png", number);
        INFO(run.out << run.err);
        CHECK(run.exit_code == 128 + number);
        CHECK(run.out.find("0 of 3 flights done (1 stopped, 2 not begun)") != std::string::npos);
        CHECK(run.out.find("stopped: 60: ended by SIGTERM after ") != std::string::npos);
        CHECK(run.out.find("failed") == std::string::npos);
        CHECK(read_file(folder / "sweep.csv").find("\n40,40,1,not begun,0,") != std::string::npos);
        CHECK(fs::exists(folder / "report.html"));
        CHECK(fs::exists(folder / "runs/60/report.html"));
        CHECK_FALSE(fs::exists(folder / "runs/60/recording.lock"));
        CHECK_FALSE(fs::exists(folder / "runs/40"));
        CHECK_FALSE(fs::exists(folder / "runs/50"));
    }
}

TEST_CASE("a signal ends a study of flights with its recording in order") {
    const auto made = tests::empty_folder("study-stopped");
    for (const auto& [number, name] : stop_signals) {
        INFO(name);
        const auto folder = made / name;
        const tests::ProgramRun run =
            tests::run_octant_and_signal({"study", "flights", "--size", "64x48", "--out", folder.string(), "--quiet"},
                folder / "f15-alone/picture-00000.png", number);
        INFO(run.err);
        CHECK(run.exit_code == 128 + number);
        CHECK(fs::exists(folder / "f15-alone/report.html"));
        CHECK_FALSE(fs::exists(folder / "f15-alone/recording.lock"));
        CHECK_FALSE(fs::exists(folder / "flights.md"));
    }
}

TEST_CASE("a signal ends a command that records no flight at once, and leaves no tables") {
    const auto made = tests::empty_folder("others-stopped");
    for (const auto& [number, name] : stop_signals) {
        INFO(name);
        const auto folder = made / name;
        const tests::ProgramRun run = tests::run_octant_and_signal(
            {"study", "popping", "--terrain", "canyon", "--out", folder.string()}, folder, number);
        CHECK(run.exit_code == 128 + number);
        CHECK(files_in(folder).empty());
    }
}

TEST_CASE("a flight does not record into a folder that another program records into") {
    const auto folder = tests::empty_folder("two-at-once");
    const ui::report::FolderLock lock(folder);
    const tests::ProgramRun run = tests::run_octant({"fly", "straight", "--size", "160x90", "--frames", "2",
        "--terrain", tests::small_ground(), "--record", folder.string(), "--quiet"});
    CHECK(run.exit_code == 2);
    CHECK(tests::lines_in(run.err) == 1);
    CHECK(run.err.find("expected a folder that nobody records into") != std::string::npos);
    CHECK(files_in(folder).size() == 1);
}

TEST_CASE("a recording of files whose names are not UTF-8 is flown again") {
    const auto made = tests::empty_folder("names");
    const auto path = made / "caf\xe9.toml";
    fs::copy_file(fs::path(OCTANT_SOURCE_DIR) / "flightpaths/f15-straight.toml", path);
    const std::string first = (made / "caf\xe9").string();
    const tests::ProgramRun run = tests::run_octant({"fly", path.string(), "--size", "64x48", "--terrain",
        tests::small_ground(), "--frames", "3", "--warm-up", "0", "--record", first, "--quiet", "--json"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const tests::ProgramRun repeat_option =
        tests::run_octant({"fly", "--settings", first + "/run.json", "--quiet", "--json"});
    INFO(repeat_option.err);
    REQUIRE(repeat_option.exit_code == 0);
    const auto hashes = [](const std::string& text) { return text.substr(text.find("state_hash")); };
    CHECK(hashes(run.out) == hashes(repeat_option.out));
}
