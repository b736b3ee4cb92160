#include "ui/flight/quality_controller.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

using namespace octant;
using ui::flight::FrameMeasurement;
using ui::flight::QualityController;
using ui::flight::QualityTargets;
using visuals::scene::Settings;

namespace {

constexpr double rate_hz = 50.0;

/// A frame of a machine that takes a microsecond for each triangle of ground and ten for each smooth polygon.
FrameMeasurement frame_of(int triangles, int smooth, int polygons) {
    FrameMeasurement outcome;
    outcome.frame_ms = 1e-3 * triangles + 1e-2 * smooth;
    outcome.terrain_triangles = triangles;
    outcome.smoothable_polygons = polygons;
    outcome.smooth_polygons = smooth;
    return outcome;
}

} // namespace

TEST_CASE("without adaptation every frame is decided as the settings say, whatever frames take") {
    Settings settings;
    settings.ground.triangles = 5000;
    QualityController quality_controller;
    quality_controller.begin(settings, rate_hz);
    for (int frame = 0; frame < 5; ++frame) {
        CHECK(quality_controller.triangle_target(frame) == 5000);
        CHECK_FALSE(quality_controller.smooth_target(frame));
        CHECK(quality_controller.add_frame(frame_of(40000, 0, 0)) == Approx(2.0));
    }
    CHECK_FALSE(quality_controller.shading());
}

TEST_CASE("the triangle target falls to what the frame's time allows, and stays there") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    QualityController quality_controller;
    quality_controller.begin(settings, rate_hz);
    CHECK(quality_controller.triangle_target(0) == 40000);
    double stress = 0.0;
    int frame = 0;
    for (; frame < 600; ++frame) {
        stress = quality_controller.add_frame(frame_of(quality_controller.triangle_target(frame), 0, 0));
    }
    CHECK(stress > 0.75);
    CHECK(stress < 0.90);
    const int settled = quality_controller.triangle_target(frame);
    CHECK(settled > 15000); // of 20,000 that a frame has time for
    CHECK(settled < 18000);
    quality_controller.add_frame(frame_of(settled, 0, 0));
    CHECK(quality_controller.triangle_target(frame + 1) == settled);
}

TEST_CASE("frames of the warm-up teach nothing") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    settings.adapt.shading = true;
    QualityController quality_controller;
    quality_controller.begin(settings, rate_hz);
    for (int frame = 0; frame < 50; ++frame) {
        FrameMeasurement slow = frame_of(100000, 10, 100);
        slow.warm_up = true;
        CHECK(std::isnan(quality_controller.add_frame(slow)));
    }
    CHECK(quality_controller.triangle_target(50) == 40000);
    CHECK(quality_controller.smooth_target(50) == 0);
    CHECK_FALSE(quality_controller.shading());
}

TEST_CASE("all polygons begin flat, and as many turn smooth as there is time for") {
    Settings settings;
    settings.adapt.shading = true;
    QualityController quality_controller;
    quality_controller.begin(settings, rate_hz);
    CHECK(quality_controller.smooth_target(0) == 0);
    constexpr int polygons = 3000; // all of them smooth would take 30 ms, a frame has 20
    std::optional<int> smooth;
    for (int frame = 0; frame < 400; ++frame) {
        smooth = quality_controller.smooth_target(frame);
        REQUIRE(smooth);
        quality_controller.add_frame(frame_of(5000, *smooth, polygons));
    }
    REQUIRE(quality_controller.shading());
    CHECK(*smooth > 1000);
    CHECK(*smooth <= 1500);
}

TEST_CASE("aircraft without polygons that could be smooth do not begin the shading's control") {
    Settings settings;
    settings.adapt.shading = true;
    QualityController quality_controller;
    quality_controller.begin(settings, rate_hz);
    quality_controller.add_frame(frame_of(5000, 0, 0));
    CHECK_FALSE(quality_controller.shading());
    CHECK(quality_controller.smooth_target(1) == 0);
}

TEST_CASE("a replay decides as it was recorded, whatever frames take, and through a new start") {
    Settings settings;
    settings.adapt.terrain = true;
    settings.adapt.shading = true;
    QualityController quality_controller;
    quality_controller.begin(settings, rate_hz);
    quality_controller.replay({{1000, std::nullopt}, {2000, 7}, {1500, 0}});
    const auto check = [&] {
        CHECK(quality_controller.triangle_target(0) == 1000);
        CHECK_FALSE(quality_controller.smooth_target(0));
        quality_controller.add_frame(frame_of(100000, 50, 100));
        CHECK(quality_controller.triangle_target(1) == 2000);
        CHECK(quality_controller.smooth_target(1) == 7);
        quality_controller.add_frame(frame_of(100000, 50, 100));
        CHECK(quality_controller.triangle_target(2) == 1500);
        CHECK(quality_controller.smooth_target(2) == 0);
    };
    check();
    quality_controller.begin(settings, rate_hz);
    check();
}

TEST_CASE("decisions that followed the clock are the same when they are replayed") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    QualityController live;
    live.begin(settings, rate_hz);
    std::vector<QualityTargets> quality_targets;
    for (int frame = 0; frame < 100; ++frame) {
        quality_targets.push_back({live.triangle_target(frame), std::nullopt});
        live.add_frame(frame_of(quality_targets.back().triangle_target, 0, 0));
    }
    QualityController repeat_option;
    repeat_option.begin(settings, rate_hz);
    repeat_option.replay(quality_targets);
    for (int frame = 0; frame < 100; ++frame) {
        CHECK(repeat_option.triangle_target(frame) == quality_targets[static_cast<std::size_t>(frame)].triangle_target);
        repeat_option.add_frame(frame_of(repeat_option.triangle_target(frame), 0, 0));
    }
}

TEST_CASE("a new start forgets what frames took") {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = true;
    settings.adapt.shading = true;
    QualityController quality_controller;
    quality_controller.begin(settings, rate_hz);
    for (int frame = 0; frame < 100; ++frame) { quality_controller.add_frame(frame_of(100000, 10, 100)); }
    CHECK(quality_controller.triangle_target(100) < 40000);
    quality_controller.begin(settings, rate_hz);
    CHECK(quality_controller.triangle_target(0) == 40000);
    CHECK_FALSE(quality_controller.shading());
}
