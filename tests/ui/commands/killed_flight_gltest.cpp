#include "tests/ui/commands/command_line.h"
#include "ui/report/loaded_recording.h"

#include <catch2/catch.hpp>

using namespace octant;

TEST_CASE("a flight that was killed is reported, losing at most its last second") {
    const auto folder = tests::empty_folder("killed") / "out";
    tests::run_octant_and_kill(
        {"fly",
         "straight",
         "--realtime",
         "--rate",
         "30",
         "--size",
         "160x90",
         "--triangles",
         "2000",
         "--pictures",
         "1",
         "--record",
         folder.string()},
        folder / "picture-00100.png");
    const tests::ProgramRun run = tests::run_octant({"report", folder.string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.err.find("ended early") != std::string::npos);
    CHECK(std::filesystem::exists(folder / "report.html"));
    CHECK(std::filesystem::exists(folder / "mangohud.csv"));
    const auto loaded = ui::report::load_recording(folder);
    REQUIRE(loaded.ended_early);
    REQUIRE(loaded.records.size() > 30);
    // In real time the last picture written tells how far the flight had come.
    const double flown_s = std::stod(loaded.pictures.back().stem().string().substr(8)) / 30.0;
    CHECK(loaded.records.back().sim_time_s > flown_s - 1.0);
}
