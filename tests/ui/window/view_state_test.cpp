#include "ui/window/panels.h"
#include "ui/window/view_state.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant::ui::window;
using namespace octant;
using octant::ui::window::Playback;
using ui::settings::RunSettings;
using visuals::scene::View;

TEST_CASE("a path plays at its speed, begins anew at its end or stops there") {
    Playback playback{.begin_s = 10.0, .end_s = 12.0, .time_s = 10.0, .speed = 2.0};
    CHECK_FALSE(playback.advance(0.5, false));
    CHECK(playback.time_s == Approx(11.0));
    CHECK(playback.advance(1.0, false));
    CHECK(playback.time_s == 10.0);
    playback.loops = false;
    CHECK_FALSE(playback.advance(5.0, false));
    CHECK(playback.time_s == 12.0);
    CHECK_FALSE(playback.playing);
    CHECK_FALSE(playback.advance(5.0, false));
    CHECK(playback.time_s == 12.0);
}

TEST_CASE("a flight by hand has no end, and a single frame pauses") {
    Playback playback{.begin_s = 0.0, .end_s = 1.0, .time_s = 0.9};
    CHECK_FALSE(playback.advance(1.0, true));
    CHECK(playback.time_s == Approx(1.9));
    playback.step_frame(0.1, true);
    CHECK(playback.time_s == Approx(2.0));
    CHECK_FALSE(playback.playing);
}

TEST_CASE("the speed doubles and halves within its limits") {
    Playback playback;
    playback.change_speed(20);
    CHECK(playback.speed == Playback::fastest);
    playback.change_speed(-40);
    CHECK(playback.speed == Playback::slowest);
}

TEST_CASE("the pace is the share of the last two seconds that was flown") {
    RealTimeFactor real_time_factor;
    CHECK(real_time_factor.share() == 1.0);
    for (int i = 0; i < 200; ++i) { real_time_factor.add(0.02, 0.02); }
    CHECK(real_time_factor.share() == Approx(1.0));
    for (int i = 0; i < 20; ++i) { real_time_factor.add(0.375, 0.25); }
    CHECK(real_time_factor.share() == Approx(2.0 / 3.0));
    real_time_factor.add(100.0, 0.25);
    CHECK(real_time_factor.share() == Approx(0.0025));
    for (int i = 0; i < 100; ++i) { real_time_factor.add(0.03, 0.03); }
    CHECK(real_time_factor.share() == Approx(1.0));
}

TEST_CASE("time that is lost is told, in simulated seconds a second") {
    ViewState state;
    for (int i = 0; i < 20; ++i) { state.real_time_factor.add(0.375, 0.25); }
    REQUIRE(status_marks(state, std::nullopt).size() == 1);
    CHECK(status_marks(state, std::nullopt).front().text == "x0.67 of real time");
    CHECK(status_marks(state, std::nullopt).front().warns);
    state.playback.speed = 2.0;
    CHECK(status_marks(state, std::nullopt).back().text == "x1.33 of real time");
    state.playback.playing = false;
    CHECK(status_marks(state, std::nullopt).front().text == "paused");
    CHECK(status_marks(state, std::nullopt).size() == 2);
}

TEST_CASE("a drag turns the look by its share of the window's height, up to straight up") {
    RunSettings settings;
    settings.view.kind = View::Cockpit;
    const RunSettings turned = ui::window::dragged(settings, {0.5F, 0.1F});
    CHECK(turned.view.azimuth_deg == Approx(-90.0));
    CHECK(turned.view.elevation_deg == Approx(18.0));
    CHECK(ui::window::dragged(settings, {0.0F, 5.0F}).view.elevation_deg == Approx(89.0));
}

TEST_CASE("the wheel zooms in and out within limits") {
    RunSettings settings;
    CHECK(ui::window::zoomed(settings, 1.0).view.zoom > 1.1);
    CHECK(ui::window::zoomed(settings, 1000.0).view.zoom == Approx(50.0));
    CHECK(ui::window::zoomed(settings, -1000.0).view.zoom == Approx(0.1));
}

TEST_CASE("the free camera begins at the last eye point and other views forget it") {
    visuals::scene::Camera camera;
    camera.eye_m = {1.0, 2.0, 3.0};
    const RunSettings free = ui::window::with_view(RunSettings(), View::Free, camera);
    REQUIRE(free.view.eye_m);
    CHECK(*free.view.eye_m == camera.eye_m);
    const RunSettings moved = ui::window::moved(free, {.right = 0, .up = 1, .ahead = 0, .fast = false}, 0.5);
    CHECK(moved.view.eye_m->z > 3.0);
    CHECK(glm::length(*moved.view.look_m - *moved.view.eye_m) ==
          Approx(glm::length(*free.view.look_m - *free.view.eye_m)));
    CHECK_FALSE(ui::window::with_view(free, View::Chase, camera).view.eye_m);
}
