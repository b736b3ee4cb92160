#include "sim/base/output_file.h"
#include "sim/base/random_generator.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/json_schema.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/commands/compare_inputs.h"
#include "ui/report/run_file.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

using namespace octant;
using Catch::Contains;
using octant::tests::PrintedJson;
using octant::tests::run_octant;

namespace {

namespace fs = std::filesystem;

const fs::path compare_schema = fs::path(OCTANT_SOURCE_DIR) / "ui/schemas/compare.json";

/// A small flight as a settings file.
fs::path small_flight(const fs::path& folder, const std::string& name, const std::string& more = {}, int frames = 20) {
    const fs::path file = folder / (name + ".json");
    write_file(file, fmt::format(R"({{"terrain": "{}", "size": "64x48", "frames": {}, "warm-up": 2{}}})",
                         tests::small_ground(), frames, more));
    return file;
}

/// Copies of a recording in which frame k of copy i takes `ms(i, k)`.
template <class FrameMs>
void write_recordings(const fs::path& recording, const fs::path& folder, int count, const FrameMs& ms) {
    const std::string text = read_file(recording / "frames.csv");
    const auto lines = split_lines(text);
    const auto names = split_fields(lines[0], ',');
    const auto column = std::ranges::find(names, "frame_ms") - names.begin();
    const std::string run = read_file(recording / "run.json");
    const std::string time = "\"start_time_utc\": \"";
    for (int i = 0; i < count; ++i) {
        const fs::path copy = folder / fmt::format("flown-r{}", i + 1);
        fs::create_directories(copy);
        std::string rows = std::string(lines[0]) + "\n";
        for (std::size_t k = 1; k < lines.size(); ++k) {
            auto fields = split_fields(lines[k], ',');
            const std::string own = fmt::format("{:.3f}", ms(i, static_cast<int>(k) - 1));
            fields[static_cast<std::size_t>(column)] = own;
            rows += fmt::format("{}\n", fmt::join(fields, ","));
        }
        write_file(copy / "frames.csv", rows);
        std::string own_run = run;
        own_run.replace(own_run.find(time) + time.size(), 24, fmt::format("2026-01-01T00:{:02}:00.000Z", i));
        write_file(copy / "run.json", own_run);
    }
}

} // namespace

TEST_CASE("two programs fly in turns, and page, table and answer say what came of it") {
    const fs::path made = tests::empty_folder("compare");
    const fs::path out = made / "out";
    const std::vector<std::string> line = {"compare", OCTANT_PROGRAM, OCTANT_PROGRAM, "--settings",
        small_flight(made, "small").string(), "--rounds", "3", "--limit", "1000000%", "--within", "2%", "--out",
        out.string(), "--json"};
    const tests::ProgramRun run = run_octant(line);
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(tests::schema_faults(run.out, compare_schema) == std::vector<std::string>());
    CHECK(run.out == read_file(out / "compare.json"));
    const PrintedJson json(run.out);
    CHECK(json["verdict"] == "not slower");
    CHECK(json["flown"] == "in turns");
    CHECK(json["old"]["commit"] == json["new"]["commit"].text());
    const PrintedJson flight = json["flights"][0];
    CHECK(flight["flight"] == "small");
    CHECK(flight["pairing"] == "rounds");
    CHECK(flight["old_runs"] == 3);
    CHECK(flight["frames"] == 18);
    CHECK(flight["turn_ms"] >= 40.0);
    CHECK(flight["same_states"] == true);
    CHECK(flight["same_pictures"] == true);
    CHECK(flight["settings"]["size"] == "64x48");
    CHECK(tests::lines_in(read_file(out / "compare.csv")) == 2);
    CHECK_THAT(read_file(out / "compare.html"), Contains("<p class=\"answer\">"));
    CHECK(fs::exists(out / "small/old-r1/picture-00000.png"));
    CHECK(fs::exists(out / "small/new-r3/run.json"));
    CHECK_FALSE(fs::exists(out / "small/new-r3/picture-00000.png"));

    // The folder of a comparison is used again, another is not.
    const tests::ProgramRun again = run_octant(line);
    CHECK(again.exit_code == 0);
    CHECK_THAT(again.err, Contains("out: the comparison there is replaced"));
    write_file(out / "letter.txt", "Dear all\n");
    tests::check_refused("compare", {OCTANT_PROGRAM, OCTANT_PROGRAM, "--out", out.string()},
        "expected an empty folder or that of a comparison, got another");
    CHECK(fs::exists(out / "small/old-r1/run.json"));
}

TEST_CASE("settings files are flown by this program, to any frame, and those that follow the clock are flown whole") {
    const fs::path made = tests::empty_folder("compare");
    const std::string before = small_flight(made, "before", R"(, "order-method": "exact")").string();
    const std::string after = small_flight(made, "after", R"(, "order-method": "paper")").string();
    const fs::path out = made / "out";
    const tests::ProgramRun run = run_octant(
        {"compare", before, after, "--max-seconds", "0", "--seed", "7", "--out", out.string(), "--quiet", "--json"});
    INFO(run.out << run.err);
    const PrintedJson json(run.out);
    CHECK(json["seed"] == 7);
    CHECK(json["flights"][0]["old_runs"] == 3); // the fewest, as there is no time for more
    CHECK(json["flights"][0]["differences"] == "");
    const std::string verdict = json["verdict"].text();
    CHECK(run.exit_code == (verdict == "slower" ? 1 : verdict == "cannot tell" ? 3 : 0));
    CHECK(ui::report::value_of(ui::report::read_run_file(out / "flight/new-r2/run.json").settings, "order-method") ==
          "paper");

    RandomGenerator dice(1);
    const std::array<ui::sweep::ComparedProgram, 2> programs{{{"old", OCTANT_PROGRAM}, {"new", OCTANT_PROGRAM}}};
    for (const int frame : {0, 7}) {
        for (const fs::path& picture : ui::sweep::fly_to_frame(programs, out / "flight", frame, dice)) {
            CHECK(picture.filename() == fmt::format("picture-{:05}.png", frame));
            CHECK(fs::exists(picture));
        }
    }

    const std::string adapting = small_flight(made, "adapting", R"(, "adapt": "terrain")").string();
    const tests::ProgramRun whole = run_octant(
        {"compare", adapting, adapting, "--rounds", "1", "--out", (made / "whole").string(), "--quiet", "--json"});
    INFO(whole.out << whole.err);
    CHECK(whole.exit_code == 3); // one round has no interval
    CHECK(PrintedJson(whole.out)["flown"] == "alternately");
    CHECK(PrintedJson(whole.out)["flights"][0]["turn_ms"].is_null());
}

TEST_CASE("recordings are compared as they are, with exit codes 0, 1 and 3") {
    const fs::path made = tests::empty_folder("compare");
    const fs::path flown = made / "flown";
    REQUIRE(
        run_octant({"fly", "--settings", small_flight(made, "small").string(), "--record", flown.string(), "--quiet"})
            .exit_code == 0);
    const auto flights_of = [&](const std::string& name, int count, double share, double noise_share) {
        RandomGenerator dice(static_cast<std::uint64_t>(1000.0 * share) + static_cast<std::uint64_t>(count));
        write_recordings(flown, made / name, count,
            [&](int, int k) { return (5.0 + k % 5) * share * (1.0 + noise_share * dice.between(-1.0, 1.0)); });
        return (made / name).string();
    };
    const std::string before = flights_of("before", 6, 1.0, 0.002);
    const auto compared = [&](const std::string& after, const std::vector<std::string>& more = {}) {
        std::vector<std::string> line = {"compare", before, after, "--quiet"};
        line.insert(line.end(), more.begin(), more.end());
        return run_octant(line);
    };
    const std::string slow = flights_of("slow", 7, 1.1, 0.002);
    const tests::ProgramRun slower = compared(slow);
    INFO(slower.out << slower.err);
    CHECK(slower.exit_code == 1);
    CHECK_THAT(slower.out, Catch::StartsWith("10.") || Catch::StartsWith("9.9"));
    CHECK_THAT(slower.out, Contains(" % slower (") && Contains("states and pictures are the same"));
    CHECK(compared(slow, {"--limit", "20%"}).exit_code == 0);
    CHECK(compared(flights_of("fast", 7, 0.9, 0.002)).exit_code == 0);
    const tests::ProgramRun few = compared(flights_of("few", 2, 1.1, 0.002));
    CHECK(few.exit_code == 3);
    CHECK_THAT(few.out, Catch::StartsWith("cannot tell"));
    CHECK(compared(flights_of("wild", 7, 1.0, 0.5)).exit_code == 3);
    CHECK_FALSE(fs::exists("octant-compare"));
    // MangoHud's log of a flight, set against itself: too few runs for an interval.
    const std::string log = (flown / "mangohud.csv").string();
    const tests::ProgramRun captures = run_octant({"compare", log, log, "--quiet", "--json"});
    INFO(captures.out << captures.err);
    CHECK(captures.exit_code == 3);
    CHECK(PrintedJson(captures.out)["flights"][0]["pairing"] == "figures");

    const fs::path out = made / "out";
    const tests::ProgramRun written = compared(slow, {"--out", out.string(), "--json"});
    CHECK(tests::schema_faults(written.out, compare_schema) == std::vector<std::string>());
    CHECK(written.out == read_file(out / "compare.json"));
    CHECK(fs::exists(out / "compare.html"));
}

TEST_CASE("frames in which a program was stopped for the other one's turn are marked, and no figure has them") {
    const fs::path made = tests::empty_folder("compare");
    const std::string before = small_flight(made, "before", R"(, "size": "320x240")", 200).string();
    const fs::path out = made / "out";
    const tests::ProgramRun run =
        run_octant({"compare", before, before, "--rounds", "3", "--limit", "1000%", "--out", out.string(), "--quiet"});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    for (const char* name : {"old-r1", "new-r1", "old-r3", "new-r3"}) {
        const ui::report::LoadedRecording flown = ui::report::load_recording(out / "flight" / name);
        INFO(name);
        CHECK(flown.flight.paused_frames() > 0);
        CHECK(flown.flight.paused_frames() + flown.statistics.frames == 198);
        CHECK(flown.disagreement.empty());
        CHECK(std::ranges::any_of(flown.run.facts, [](const auto& fact) {
            return fact.first == "note" && fact.second.find("turns of octant compare") != std::string::npos;
        }));
    }
    CHECK_THAT(read_file(out / "compare.html"), Contains("the program was stopped"));
    CHECK_THAT(read_file(out / "compare.html"), !Contains("does not record when it is stopped"));
    const auto start_of = [&](const char* name) {
        return ui::report::read_run_file(out / "flight" / name / "run.json").machine_info.start_time_utc;
    };
    CHECK(start_of("old-r1") != start_of("new-r1"));
}

TEST_CASE("what is compared is never removed, and what is left out of it is told") {
    const fs::path made = tests::empty_folder("compare");
    const fs::path out = made / "out";
    const std::string file = small_flight(made, "small").string();
    REQUIRE(run_octant({"compare", file, file, "--rounds", "1", "--out", out.string(), "--quiet"}).exit_code == 3);
    const std::string old = (out / "flight/old-r1").string();
    tests::check_refused("compare", {old, old, "--out", out.string()},
        "expected a folder without what is compared, got one with " + old);
    tests::check_refused("compare", {(out / "flight/old.json").string(), file, "--out", out.string()},
        "expected a folder without what is compared");
    CHECK(fs::exists(out / "flight/old-r1/frames.csv"));
    // A damaged capture is refused by its line; one in a folder of captures is named.
    const std::string log = old + "/mangohud.csv";
    const fs::path captures = made / "captures";
    fs::create_directories(captures);
    fs::copy_file(log, captures / "one.csv");
    const std::string damaged = (captures / "two.csv").string();
    write_file(damaged, read_file(log) + "125.0,fast,0\n");
    tests::check_refused("compare", {log, damaged}, "two.csv:");
    const tests::ProgramRun run = run_octant({"compare", log, captures.string()});
    INFO(run.out << run.err);
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.err, Contains("note: left out: ") && Contains("two.csv:"));
}

TEST_CASE("a report tells changes in JSON, and its gate ends as octant compare does") {
    const fs::path made = tests::empty_folder("report-gate");
    const fs::path flown = made / "flown";
    REQUIRE(
        run_octant({"fly", "--settings", small_flight(made, "small").string(), "--record", flown.string(), "--quiet"})
            .exit_code == 0);
    RandomGenerator dice(3);
    const auto write_variant = [&](const std::string& name, double share) {
        write_recordings(flown, made / name, 4,
            [&](int, int k) { return (5.0 + k % 5) * share * (1.0 + 0.002 * dice.between(-1.0, 1.0)); });
        for (int i = 1; i <= 4; ++i) { // another build
            const fs::path run = made / name / fmt::format("flown-r{}", i) / "run.json";
            std::string text = read_file(run);
            const std::string key = "\"commit\": \"";
            text.insert(text.find(key) + key.size(), name);
            const std::string summary = "\"summary\""; // of the flight that was copied
            text.replace(text.find(summary), summary.size(), "\"old summary\"");
            write_file(run, text);
        }
    };
    write_variant("before", 1.0);
    write_variant("after", 1.2);
    std::vector<std::string> line = {"report"};
    for (const char* side : {"before", "after"}) {
        for (int i = 1; i <= 4; ++i) { line.push_back((made / side / fmt::format("flown-r{}", i)).string()); }
    }
    line.insert(line.end(), {"--out", (made / "page.html").string(), "--quiet"});
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = line;
        all.insert(all.end(), more.begin(), more.end());
        return run_octant(all);
    };
    const tests::ProgramRun json = with({"--json", "--gate", "p50=5%"});
    INFO(json.out << json.err);
    CHECK(json.exit_code == 1);
    const fs::path schema = fs::path(OCTANT_SOURCE_DIR) / "ui/schemas/report.json";
    CHECK(tests::schema_faults(json.out, schema) == std::vector<std::string>());
    const PrintedJson printed(json.out);
    CHECK(printed["changes"][0]["changed"] == true);
    CHECK(printed["changes"][0]["change_percent"] >= 19.0);
    CHECK(printed["changes"][0]["old_runs"] == 4);
    CHECK(with({"--gate", "p50=25%"}).exit_code == 0);
    line.erase(line.begin() + 3, line.begin() + 5); // two are left before
    const tests::ProgramRun few = with({"--gate", "p50=25%"});
    CHECK(few.exit_code == 3);
    CHECK_THAT(few.out, Catch::StartsWith("cannot tell: ") &&
                            Contains("p50_ms: expected three runs or more of each variant, got 2 and 4"));
    line.erase(line.begin() + 3, line.begin() + 7);
    const tests::ProgramRun one = with({"--gate", "p50=25%"});
    CHECK(one.exit_code == 3);
    CHECK_THAT(one.out, Catch::StartsWith("cannot tell: all recordings are repeats of one variant"));
}

TEST_CASE("sides of a comparison that do not go together are refused") {
    const fs::path made = tests::empty_folder("compare");
    const std::string program = OCTANT_PROGRAM;
    const std::string file = small_flight(made, "small").string();
    const std::string empty = (made / "empty").string();
    fs::create_directories(empty);
    write_file(made / "text.txt", "Dear all\n");
    const auto refuse = [](const std::vector<std::string>& line, const std::string& why) {
        tests::check_refused("compare", line, why);
    };
    refuse({program}, "NEW");
    refuse({program, file}, "small.json: expected a program as " + program + " is, got a settings file");
    refuse({empty, program}, "got a program");
    refuse({program, (made / "none").string()}, "none: expected a program, a settings file");
    refuse({program, (made / "text.txt").string()}, "got none of them");
    refuse({empty, empty}, "expected a recording or a folder of recordings, found none in it");
    refuse({file, file, "--settings", file}, "--settings: expected two programs beside it");
    refuse({program, program, "--within", "2"}, "--within: expected a percentage of 0 or more, such as 2%, got '2'");
    refuse({program, program, "--limit", "-1%"}, "--limit: expected a percentage");
    refuse({program, program, "--settings", (made / "none.json").string()}, "none.json: expected a file");
    refuse({program, program, "--rounds", "0"}, "--rounds");
    const std::string out = (made / "out").string();
    refuse({"/bin/true", program, "--out", out, "--settings", file}, "got one that ended without it");
    refuse({program, "/bin/false", "--out", out, "--settings", file}, "/bin/false: ended with exit code 1");
    CHECK(fs::exists(made / "out/small/old.log"));
}

TEST_CASE("a comparison that is stopped ends both flights in order") {
    const fs::path made = tests::empty_folder("compare");
    const std::string file = small_flight(made, "long", "", 100000).string();
    const fs::path out = made / "out";
    const tests::ProgramRun run = tests::run_octant_and_signal(
        {"compare", OCTANT_PROGRAM, OCTANT_PROGRAM, "--settings", file, "--out", out.string(), "--quiet"},
        out / "long/new-r1/run.json", SIGTERM);
    CHECK(run.exit_code == 128 + SIGTERM);
    for (const char* side : {"old-r1", "new-r1"}) {
        if (fs::exists(out / "long" / side / "run.json")) {
            CHECK_THAT(ui::report::read_run_file(out / "long" / side / "run.json").stopped, Contains("SIGTERM"));
        }
    }
}

TEST_CASE("the flights of a sweep's file are those of a comparison, each once") {
    const fs::path made = tests::empty_folder("compare");
    write_file(made / "s.toml", "repeats = 3\n[vary]\nfov = [40, 50]\n");
    std::vector<std::string> notes;
    const std::array files{(made / "s.toml").string(), small_flight(made, "40").string()};
    const auto flights = ui::commands::compared_flight_settings(files, notes);
    REQUIRE(flights.size() == 3);
    CHECK(flights[0].name == "40");
    CHECK(flights[1].name == "50");
    CHECK(flights[2].name == "40-2");
    CHECK(notes.empty());
    const auto standard = ui::commands::compared_flight_settings({}, notes);
    REQUIRE(standard.size() == 1);
    CHECK(ui::sweep::changed_settings_json(standard[0].settings[0]) ==
          "{\n  \"path\": \"turn\",\n  \"size\": \"640x360\",\n  \"frames\": 200\n}\n");
}
