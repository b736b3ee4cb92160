#include "ui/flight/decider.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

using namespace octant;
using ui::flight::Decider;
using ui::flight::Decision;
using ui::flight::FrameOutcome;
using visuals::scene::Settings;

namespace {

constexpr double rate_hz = 50.0;

/// A frame of a machine that takes a microsecond for each triangle of ground and ten for each
/// smooth polygon.
FrameOutcome frame_of(int triangles, int smooth, int polygons) {
    FrameOutcome outcome;
    outcome.frame_ms = 1e-3 * triangles + 1e-2 * smooth;
    outcome.terrain_triangles = triangles;
    outcome.may_be_smooth = polygons;
    outcome.smooth_polygons = smooth;
    return outcome;
}

} // namespace

TEST_CASE("without adaptation every frame is decided as the settings say, whatever frames take") {
    Settings settings;
    settings.ground.triangles = 5000;
    Decider decider;
    decider.begin(settings, rate_hz);
    for (int frame = 0; frame < 5; ++frame) {
        CHECK(decider.triangle_target(frame) == 5000);
        CHECK_FALSE(decider.smooth_target(frame));
        CHECK(decider.learn(frame_of(40000, 0, 0)) == Approx(2.0));
    }
    CHECK_FALSE(decider.shading());
}

TEST_CASE("the triangle target falls to what the frame's time allows, and stays there") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    Decider decider;
    decider.begin(settings, rate_hz);
    CHECK(decider.triangle_target(0) == 40000);
    double stress = 0.0;
    int frame = 0;
    for (; frame < 600; ++frame) {
        stress = decider.learn(frame_of(decider.triangle_target(frame), 0, 0));
    }
    CHECK(stress > 0.75);
    CHECK(stress < 0.90);
    const int settled = decider.triangle_target(frame);
    CHECK(settled > 15000); // of 20,000 that a frame has time for
    CHECK(settled < 18000);
    decider.learn(frame_of(settled, 0, 0));
    CHECK(decider.triangle_target(frame + 1) == settled);
}

TEST_CASE("frames of the warm-up teach nothing") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    settings.adapt.shading = true;
    Decider decider;
    decider.begin(settings, rate_hz);
    for (int frame = 0; frame < 50; ++frame) {
        FrameOutcome slow = frame_of(100000, 10, 100);
        slow.warm_up = true;
        CHECK(std::isnan(decider.learn(slow)));
    }
    CHECK(decider.triangle_target(50) == 40000);
    CHECK(decider.smooth_target(50) == 0);
    CHECK_FALSE(decider.shading());
}

TEST_CASE("all polygons begin flat, and as many turn smooth as there is time for") {
    Settings settings;
    settings.adapt.shading = true;
    Decider decider;
    decider.begin(settings, rate_hz);
    CHECK(decider.smooth_target(0) == 0);
    constexpr int polygons = 3000; // all of them smooth would take 30 ms, a frame has 20
    std::optional<int> smooth;
    for (int frame = 0; frame < 400; ++frame) {
        smooth = decider.smooth_target(frame);
        REQUIRE(smooth);
        decider.learn(frame_of(5000, *smooth, polygons));
    }
    REQUIRE(decider.shading());
    CHECK(*smooth > 1000);
    CHECK(*smooth <= 1500);
}

TEST_CASE("aircraft without polygons that could be smooth do not begin the shading's control") {
    Settings settings;
    settings.adapt.shading = true;
    Decider decider;
    decider.begin(settings, rate_hz);
    decider.learn(frame_of(5000, 0, 0));
    CHECK_FALSE(decider.shading());
    CHECK(decider.smooth_target(1) == 0);
}

TEST_CASE("a replay decides as it was recorded, whatever frames take, and through a new start") {
    Settings settings;
    settings.adapt.terrain = true;
    settings.adapt.shading = true;
    Decider decider;
    decider.begin(settings, rate_hz);
    decider.replay({{1000, -1}, {2000, 7}, {1500, 0}});
    const auto check = [&] {
        CHECK(decider.triangle_target(0) == 1000);
        CHECK_FALSE(decider.smooth_target(0));
        decider.learn(frame_of(100000, 50, 100));
        CHECK(decider.triangle_target(1) == 2000);
        CHECK(decider.smooth_target(1) == 7);
        decider.learn(frame_of(100000, 50, 100));
        CHECK(decider.triangle_target(2) == 1500);
        CHECK(decider.smooth_target(2) == 0);
    };
    check();
    decider.begin(settings, rate_hz);
    check();
}

TEST_CASE("decisions that followed the clock are the same when they are replayed") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    Decider live;
    live.begin(settings, rate_hz);
    std::vector<Decision> decisions;
    for (int frame = 0; frame < 100; ++frame) {
        decisions.push_back({live.triangle_target(frame), -1});
        live.learn(frame_of(decisions.back().triangle_target, 0, 0));
    }
    Decider again;
    again.begin(settings, rate_hz);
    again.replay(decisions);
    for (int frame = 0; frame < 100; ++frame) {
        CHECK(
            again.triangle_target(frame) ==
            decisions[static_cast<std::size_t>(frame)].triangle_target);
        again.learn(frame_of(again.triangle_target(frame), 0, 0));
    }
}

TEST_CASE("a new start forgets what frames took") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    settings.adapt.shading = true;
    Decider decider;
    decider.begin(settings, rate_hz);
    for (int frame = 0; frame < 100; ++frame) {
        decider.learn(frame_of(100000, 10, 100));
    }
    CHECK(decider.triangle_target(100) < 40000);
    decider.begin(settings, rate_hz);
    CHECK(decider.triangle_target(0) == 40000);
    CHECK_FALSE(decider.shading());
}
