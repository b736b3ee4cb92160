#include "sim/base/axes.h"
#include "tests/ui/window/driven_viewer.h"
#include "ui/flight/session.h"
#include "ui/report/packed_recording.h"
#include "ui/settings/settings_file.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

using namespace octant;
using namespace octant::tests;
using ui::settings::RunSettings;
namespace fs = std::filesystem;

namespace {

nlohmann::json run_of(const fs::path& folder) {
    std::ifstream file(folder / "run.json");
    return nlohmann::json::parse(file);
}

/// State hash of what a recording's settings fly without a window.
std::string flown_again(const fs::path& folder) {
    RunSettings settings = ui::settings::read_settings(folder / "run.json");
    settings.view.size_px = {64, 48};
    settings.ground.triangles = 500;
    ui::flight::Session session(settings);
    for (int frame = 0; frame < session.frames(); ++frame) { session.draw(frame); }
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(session.state_hash()));
    return text;
}

double heading_rad(ui::flight::Simulation& simulation) {
    return euler_from_body_to_world(simulation.states().front().body_to_world).heading_rad;
}

} // namespace

TEST_CASE("a path is scrubbed by its keys, faster and slower, and begins anew at its end") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("space");
    driven->strike("Home");
    driven->strike("slash");
    driven->strike("slash");
    CHECK(driven->state().playback.time_s == Approx(4.0));
    driven->strike("comma");
    CHECK(driven->state().playback.time_s == Approx(2.0));
    CHECK(driven->viewer().session().simulation().time_s() == Approx(2.0));
    driven->strike("bracketright");
    driven->strike("bracketright");
    CHECK(driven->state().playback.speed == Approx(4.0));
    driven->strike("bracketleft");
    CHECK(driven->state().playback.speed == Approx(2.0));
    driven->state().requests.go_to_s = driven->state().playback.end_s - 0.2;
    driven->turns(2);
    driven->strike("space");
    CHECK(driven->until([&] { return driven->state().playback.time_s < 5.0; }));
}

TEST_CASE("a flight by hand leaves trim, turns where the stick goes, and its recording repeats it") {
    RunSettings settings = small_flight();
    const auto driven = DrivenViewer::open(settings);
    if (!driven) { return; }
    ui::flight::Simulation& simulation = driven->viewer().session().simulation();
    driven->strike("h");
    driven->strike("t");
    REQUIRE(simulation.by_hand());
    const double heading_before_rad = heading_rad(simulation);
    const double height_before_m = simulation.states().front().position_m.z;
    driven->strike("F9");
    REQUIRE(driven->state().recording.has_value());
    const fs::path folder = *driven->state().recording;
    driven->hold("Right", 0.3);
    driven->hold("Down", 3.0);
    const double turned_rad = std::remainder(heading_rad(simulation) - heading_before_rad, 2.0 * 3.14159265358979);
    CHECK(turned_rad > 0.05);
    CHECK(simulation.states().front().position_m.z > height_before_m - 200.0);
    driven->strike("F9");
    CHECK_FALSE(driven->state().recording.has_value());
    CHECK(fs::exists(folder / "report.html"));
    const nlohmann::json run = run_of(folder);
    CHECK(run["summary"]["frames"].get<int>() > 10);
    CHECK(run["settings"]["path"].get<std::string>().ends_with("flight.csv"));
    CHECK(flown_again(folder) == run["summary"]["state_hash"].get<std::string>());
    // From the packed file alone, elsewhere.
    const fs::path elsewhere = folder.parent_path() / "elsewhere";
    fs::create_directories(elsewhere);
    ui::report::pack_recording(folder, elsewhere / "by-hand.zip", false);
    fs::remove_all(folder);
    const ui::report::RecordingFolder packed = ui::report::open_recording(elsewhere / "by-hand.zip");
    CHECK(flown_again(packed.path) == run["summary"]["state_hash"].get<std::string>());
    fs::remove_all(elsewhere);
}

TEST_CASE("a recording along a path has the states of the same flight without a window") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->turns(10);
    driven->strike("F9");
    REQUIRE(driven->state().recording.has_value());
    const fs::path folder = *driven->state().recording;
    driven->turns(20);
    driven->strike("bracketright");
    driven->turns(20);
    driven->strike("space");
    driven->turns(5);
    driven->strike("3");
    driven->strike("space");
    driven->turns(10);
    driven->strike("F9");
    const nlohmann::json run = run_of(folder);
    CHECK(flown_again(folder) == run["summary"]["state_hash"].get<std::string>());
    CHECK(fs::exists(folder / "report.html"));
    CHECK(fs::exists(folder / "track.csv"));
}

TEST_CASE("changing path, aircraft and ground in the window loads them, and a wrong one says so") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->state().next_settings.path.name = "turn";
    driven->state().next_settings.path.aircraft = {"500md"};
    driven->state().next_settings.path.terrain = "canyon";
    driven->turns(3);
    CHECK(driven->settings().path.terrain == "canyon");
    CHECK(driven->viewer().session().world().flight.title == "500md turn over canyon");
    driven->state().next_settings.path.name = "no-such-path";
    driven->turns(3);
    CHECK(driven->settings().path.name == "turn");
    CHECK(driven->state().message.text.find("no-such-path") != std::string::npos);
}

TEST_CASE("a flight by hand into the ground stops with a message, and its recording repeats it") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("h");
    driven->strike("F9");
    REQUIRE(driven->state().recording.has_value());
    const fs::path folder = *driven->state().recording;
    driven->state().playback.speed = 4.0;
    driven->display().press("Up");
    ui::flight::Simulation& simulation = driven->viewer().session().simulation();
    CHECK(driven->until([&] { return simulation.end_of_flight().has_value(); }));
    driven->display().release("Up");
    driven->turns(2);
    CHECK(simulation.end_of_flight() == ui::flight::Simulation::End::OnTheGround);
    CHECK_FALSE(driven->state().playback.playing);
    CHECK(driven->state().message.text.find("ground") != std::string::npos);
    driven->strike("F9");
    CHECK(flown_again(folder) == run_of(folder)["summary"]["state_hash"].get<std::string>());
}

TEST_CASE("Esc asks while a recording is made, and leaves at once where none is") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("F9");
    REQUIRE(driven->state().recording.has_value());
    driven->strike("Escape");
    CHECK(driven->state().open.leave_question);
    CHECK(driven->viewer().run_frame());
    driven->strike("Escape");
    CHECK_FALSE(driven->state().open.leave_question);
    CHECK(driven->viewer().run_frame());
    driven->strike("Escape");
    driven->state().requests.leave_recording = true;
    CHECK_FALSE(driven->viewer().run_frame());
    CHECK(driven->viewer().finish_recording().has_value());
    driven->state().requests.leave_recording = false;
    driven->state().open.leave_question = false;
    driven->display().strike("Escape");
    CHECK(driven->until([&] { return driven->state().requests.leave; }));
}

TEST_CASE("another way to remove hidden surfaces keeps the flight's time") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("space");
    driven->strike("Home");
    driven->strike("slash");
    driven->state().next_settings.surface.hidden_surface = visuals::scene::HiddenSurface::DepthBuffer;
    driven->turns(3);
    CHECK(driven->settings().surface.hidden_surface == visuals::scene::HiddenSurface::DepthBuffer);
    CHECK(driven->viewer().session().simulation().time_s() == Approx(2.0));
}
