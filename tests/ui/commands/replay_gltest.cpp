#include "models/meshfile/mesh_file.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/report/frame_csv.h"
#include "ui/report/loaded_recording.h"
#include "ui/studies/hybrid_shading/study_shading.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

using namespace octant;
using Catch::Contains;
using octant::tests::run_octant;

namespace {

namespace fs = std::filesystem;
using Records = std::vector<ui::report::FrameRecord>;

/// An adapting flight over a small ground, at a rate that no machine keeps up with, recorded once.
const fs::path& recorded() {
    static const fs::path folder = [] {
        const auto made = tests::empty_folder("replay");
        const std::string ground = (made / "ground.tif").string();
        REQUIRE(run_octant({"terrain", "make", "--kind", "hills", "--size", "257", "--out", ground}).exit_code == 0);
        // The ground has no place: with a palette nothing about its climate is guessed, and nothing to be told.
        const tests::ProgramRun run = run_octant(
            {"fly", "turn", "--terrain", ground, "--palette", "temperate", "--adapt", "terrain", "--triangles", "20000",
                "--rate", "1000", "--size", "320x240", "--frames", "60", "--warm-up", "2", "--pictures", "0",
                "--record", (made / "flight").string(), "--no-near-detail", "--no-scenery", "--quiet"});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return made / "flight";
    }();
    return folder;
}

Records rows_of(const fs::path& folder) { return ui::report::read_frame_csv(folder / "frames.csv").records; }

/// A copy of the flight's run.json with rows that have been changed.
fs::path changed(const std::string& name, const std::function<void(Records&)>& change) {
    const fs::path folder = recorded().parent_path() / name;
    fs::create_directories(folder);
    fs::copy_file(recorded() / "run.json", folder / "run.json", fs::copy_options::overwrite_existing);
    Records rows = rows_of(recorded());
    change(rows);
    std::string text = ui::report::frame_csv_header();
    for (const auto& row : rows) { text += ui::report::frame_csv_line(row); }
    write_file(folder / "frames.csv", text);
    return folder;
}

tests::ProgramRun replay(const fs::path& folder, const std::vector<std::string>& further = {}) {
    std::vector<std::string> words = {"fly", "--replay", folder.string()};
    words.insert(words.end(), further.begin(), further.end());
    return run_octant(words);
}

} // namespace

TEST_CASE("a flight whose triangles followed the clock is replayed bit for bit") {
    const tests::ProgramRun run = replay(recorded());
    INFO(run.err);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("same states, same pictures as " + recorded().string()));
    const Records rows = rows_of(recorded());
    REQUIRE(rows.size() == 60);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double ratio =
            static_cast<double>(rows[i].triangle_target) / static_cast<double>(rows[i - 1].triangle_target);
        CHECK(ratio > 0.979);
        CHECK(ratio < 1.006);
    }
    CHECK(rows[1].triangle_target == 20000); // warming up
    CHECK_FALSE(std::isfinite(rows[1].stress));
    CHECK(std::isfinite(rows[2].stress));
}

TEST_CASE("a flight whose shading followed the clock is replayed bit for bit, whatever cells it saw") {
    const fs::path folder = tests::empty_folder("replayed-shading");
    const tests::ProgramRun flown = run_octant({"fly", "jinking", "--aircraft", "f15", "--aircraft", "500md", "--view",
        "tower", "--terrain", tests::small_ground(), "--adapt", "shading", "--rate", "20", "--size", "160x90",
        "--frames", "150", "--pictures", "0", "--record", folder.string(), "--quiet"});
    INFO(flown.err);
    REQUIRE(flown.exit_code == 0);
    const Records rows = rows_of(folder);
    CHECK(rows.front().smooth_target == 0); // the safe side
    CHECK(rows.back().smooth_target >= 0);
    CHECK(rows.back().smooth_polygons == rows.back().smooth_target);
    const tests::ProgramRun repeat_option = replay(folder);
    INFO(repeat_option.err);
    CHECK(repeat_option.exit_code == 0);
    CHECK_THAT(repeat_option.out, Contains("same states, same pictures"));
}

TEST_CASE("a mesh and a second view whose shading followed the clock are replayed bit for bit") {
    const fs::path mesh = tests::empty_folder("shaded-mesh") / "ball.ply";
    models::meshfile::write_mesh(mesh, ui::studies::hybrid_shading::uneven_ball(24, 49));
    const fs::path folder = tests::empty_folder("replayed-mesh-shading");
    const tests::ProgramRun flown = run_octant({"fly", "turn", "--aircraft", mesh.string(), "--inset", "orbit",
        "--terrain", "none", "--adapt", "shading", "--rate", "20", "--size", "320x180", "--frames", "60", "--pictures",
        "0", "--record", folder.string(), "--quiet", "--aircraft-error-px", "0.2"});
    INFO(flown.err);
    REQUIRE(flown.exit_code == 0);
    const Records rows = rows_of(folder);
    CHECK(rows.front().smooth_polygons == 0); // the safe side
    CHECK(rows.front().aircraft_polygons > 300);
    CHECK(rows.back().smooth_polygons == std::min(rows.back().smooth_target, rows.back().aircraft_polygons));
    const tests::ProgramRun repeat_option = replay(folder);
    INFO(repeat_option.err);
    CHECK(repeat_option.exit_code == 0);
    CHECK_THAT(repeat_option.out, Contains("same states, same pictures"));
}

TEST_CASE("other targets in the rows give other pictures, and the check says so") {
    const auto half = changed("half", [](Records& rows) {
        for (std::size_t i = 10; i < rows.size(); ++i) {
            rows[i].triangle_target = 1000 + 100 * static_cast<int>(i % 7);
        }
    });
    const auto repeat_option = recorded().parent_path() / "again";
    const tests::ProgramRun run = replay(half, {"--record", repeat_option.string(), "--json", "--quiet"});
    CHECK(run.exit_code == 1);
    const auto json = tests::PrintedJson(run.out);
    CHECK(json["replay"]["state_hash"] == "same");
    CHECK(json["replay"]["picture_hash"] == "other");
    const Records rows = rows_of(repeat_option);
    REQUIRE(rows.size() == 60);
    CHECK(rows[10].triangle_target == 1300);
    CHECK(rows[10].terrain_triangles <= 1300);
    CHECK(rows[10].terrain_triangles > 1200);
    CHECK(replay(repeat_option).exit_code == 0); // a replay is a recording like any other
    CHECK_THAT(read_text_file(repeat_option / "run.json"), Contains("\"replay of\": \"" + half.filename().string()));
}

TEST_CASE("what is left of a killed flight is replayed, and nothing says that it is the same") {
    const auto killed = changed("killed", [](Records& rows) { rows.resize(20); });
    const tests::PrintedJson json(read_text_file(killed / "run.json"));
    write_file(killed / "run.json", json.without({"summary"}).printed());
    write_file(killed / "frames.csv", read_text_file(killed / "frames.csv") + "20,0.0");
    const tests::ProgramRun run = replay(killed);
    INFO(run.err);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains("has 20 of 60 frames"));
    CHECK_THAT(run.out, Contains("cut short after 20 frames and has no hashes"));
}

TEST_CASE("rows that cannot be replayed are refused with their line") {
    tests::check_refusal(replay("/nowhere"), "/nowhere/run.json: expected a file, found none");
    const auto gap = changed("gap", [](Records& rows) { rows.erase(rows.begin() + 3); });
    tests::check_refusal(replay(gap), "frames.csv:5: expected frame 3, got 4");
    const auto none = changed("none", [](Records& rows) { rows[7].triangle_target = 0; });
    tests::check_refusal(replay(none), "frames.csv:9: expected a triangle_target from 1 to");
    const auto long_one = changed("long", [](Records& rows) {
        rows.push_back(rows.back());
        rows.back().frame = 60;
    });
    tests::check_refusal(replay(long_one), "frames.csv:62: expected at most the 60 frames");
    const auto empty = changed("empty", [](Records& rows) { rows.clear(); });
    tests::check_refusal(replay(empty), "frames.csv: expected the rows of a flight, got none");

    const auto damaged = changed("damaged", [](Records&) {});
    const std::string text = read_text_file(damaged / "frames.csv");
    std::string renamed = text;
    renamed.replace(renamed.find("triangle_target"), 15, "triangle_budget");
    write_file(damaged / "frames.csv", renamed);
    tests::check_refusal(replay(damaged), "frames.csv:1: expected a column triangle_target");
    write_file(damaged / "frames.csv", text + "60,x\n");
    tests::check_refusal(replay(damaged), "frames.csv:62: expected 55 fields, got 2");
    fs::remove(damaged / "frames.csv");
    tests::check_refusal(replay(damaged), "frames.csv: expected a file, found none");
}

TEST_CASE("beside a replay nothing may be asked for that changes pictures") {
    const std::string expected = "--replay: expected no option beside it that may change pictures";
    tests::check_refusal(replay(recorded(), {"--triangles", "5000"}), expected + ", got --triangles");
    tests::check_refusal(replay(recorded(), {"straight"}), expected + ", got path");
    tests::check_refusal(replay(recorded(), {"--show", "no-shadows"}), expected + ", got --show no-shadows");
    tests::check_refusal(replay(recorded(), {"--show", "path-ribbon,no-roads"}), expected + ", got --show path-ribbon");
    tests::check_refusal(replay(recorded(), {"--haze", "height=900"}), expected + ", got --haze height");
    tests::check_refusal(replay(recorded(), {"--no-scenery"}), expected + ", got --no-scenery");
    tests::check_refusal(
        replay(recorded(), {"--settings", (recorded() / "run.json").string()}), expected + ", got --settings");
    tests::check_refusal(replay(recorded(), {"--record", recorded().string()}), "--record: expected another folder");
    CHECK(replay(recorded(), {"--warm-up", "0", "--pictures", "7"}).exit_code == 0);
}

TEST_CASE("adaptation is refused where there is nothing to adapt") {
    const auto fly = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"fly", "straight", "--adapt", "terrain", "--frames", "2"});
        return run_octant(words);
    };
    tests::check_refusal(fly({"--terrain-lod", "paper:control=damped"}),
        "--adapt terrain: expected --terrain-lod screen-error or exact");
    tests::check_refusal(fly({"--terrain", "background60"}), "expected ground with levels of detail");
    tests::check_refusal(run_octant({"fly", "straight", "--adapt", "terrain,sound"}),
        "--adapt: expected none or a list of terrain, shading, got 'terrain,sound'");
}
