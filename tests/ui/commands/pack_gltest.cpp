#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"

#include <catch2/catch.hpp>

using namespace octant;
using octant::tests::run_octant;

namespace {

namespace fs = std::filesystem;

std::string hashes_in(const std::string& text) { return text.substr(text.find("state_hash")); }

/// A small flight along a path, by an aircraft and over a ground that are all files.
std::vector<std::string> flight_in(const fs::path& from, const fs::path& recording) {
    const fs::path source = OCTANT_SOURCE_DIR;
    fs::copy_file(source / "flightpaths/500md-turn.toml", from / "way.toml");
    fs::copy_file(source / "models/500md.obj", from / "mine.obj");
    fs::copy_file(source / "models/500md.mtl", from / "500md.mtl");
    const std::string ground = (from / "ground.tif").string();
    REQUIRE(run_octant({"terrain", "make", "--kind", "hills", "--size", "129", "--out", ground}).exit_code == 0);
    return {"fly", (from / "way.toml").string(), "--aircraft", (from / "mine.obj").string(), "--terrain", ground,
        "--order-cache", (from / "orders").string(), "--size", "96x64", "--frames", "6", "--warm-up", "0", "--pictures",
        "5", "--record", recording.string(), "--quiet", "--json"};
}

} // namespace

TEST_CASE("a packed recording is flown and reported when nothing else of it is left") {
    const auto made = tests::empty_folder("packed");
    fs::create_directories(made / "there");
    fs::create_directories(made / "elsewhere");
    const tests::ProgramRun flown = run_octant(flight_in(made / "there", made / "there/flight"));
    INFO(flown.err);
    REQUIRE(flown.exit_code == 0);
    const std::string run = read_file(made / "there/flight/run.json");
    CHECK(run.find(made.string()) == std::string::npos); // nothing absolute
    CHECK(fs::exists(made / "there/flight/inputs/500md.mtl"));
    const std::string zip = (made / "elsewhere/flight.zip").string();
    REQUIRE(
        run_octant({"pack", (made / "there/flight").string(), "--out", zip, "--with-terrain", "--quiet"}).exit_code ==
        0);
    fs::remove_all(made / "there");

    const tests::ProgramRun repeat_option = run_octant({"fly", "--settings", zip, "--quiet", "--json"});
    INFO(repeat_option.err);
    REQUIRE(repeat_option.exit_code == 0);
    CHECK(hashes_in(repeat_option.out) == hashes_in(flown.out));
    const tests::ProgramRun replay = run_octant({"fly", "--replay", zip, "--quiet"});
    CHECK(replay.exit_code == 0);
    CHECK(replay.out.find("same states, same pictures as " + zip + "\n") != std::string::npos);
    const std::string page = (made / "page.html").string();
    CHECK(run_octant({"report", zip, "--out", page, "--quiet"}).exit_code == 0);
    CHECK(read_file(page).find(hashes_in(flown.out).substr(14, 16)) != std::string::npos);
}

TEST_CASE("a run is not flown again where its recording lies, and takes the place of itself") {
    const auto made = tests::empty_folder("in-place");
    const auto recording = made / "flight";
    REQUIRE(run_octant(flight_in(made, recording)).exit_code == 0);
    const std::string before = read_file(recording / "inputs/way.toml");
    for (const char* name : {"way.toml", "mine.obj", "500md.mtl"}) { fs::remove(made / name); }
    const tests::ProgramRun repeat_option =
        run_octant({"fly", "--settings", (recording / "run.json").string(), "--record", recording.string(), "--quiet"});
    INFO(repeat_option.err);
    CHECK(repeat_option.exit_code == 0);
    CHECK(read_file(recording / "inputs/way.toml") == before);
}

TEST_CASE("a fault in a packed recording names the packed file") {
    const auto made = tests::empty_folder("faulty-pack");
    const auto recording = made / "flight";
    REQUIRE(run_octant(flight_in(made, recording)).exit_code == 0);
    const std::string zip = (made / "flight.zip").string();
    const std::string page = (made / "page.html").string();
    REQUIRE(run_octant({"pack", recording.string(), "--out", zip, "--quiet"}).exit_code == 0);
    const tests::ProgramRun results = run_octant({"report", zip, "--out", page, "--json"});
    CHECK(results.out.find("\"folder\": \"" + zip + "\"") != std::string::npos);

    std::string rows = read_file(recording / "frames.csv");
    const std::size_t third_line = rows.find('\n', rows.find('\n') + 1) + 1;
    rows.replace(third_line, 1, "x");
    write_file(recording / "frames.csv", rows);
    const std::string faulty = (made / "faulty.zip").string();
    REQUIRE(run_octant({"pack", recording.string(), "--out", faulty, "--quiet"}).exit_code == 0);
    tests::check_refused("report", {faulty, "--out", page}, faulty + "/frames.csv:3: expected");
    const tests::ProgramRun replay = run_octant({"fly", "--replay", faulty});
    CHECK(replay.exit_code == 2);
    CHECK(replay.err.find("octant: " + faulty + "/frames.csv:3: expected") == 0);
}

TEST_CASE("what cannot be packed is told in one line") {
    const auto made = tests::empty_folder("no-pack");
    tests::check_refused("pack", {(made / "none").string()}, "expected the folder of a recording");
    tests::check_refused("pack", {made.string()}, "run.json: expected a file, found none");
    write_file(made / "a.zip", "no zip");
    tests::check_refused("report", {(made / "a.zip").string(), "--out", "/dev/null"}, "expected a zip file");
}
