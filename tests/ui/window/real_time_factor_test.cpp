#include "ui/window/status_marks.h"
#include "ui/window/view_state.h"

#include <catch2/catch.hpp>

using namespace octant::ui::window;

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
