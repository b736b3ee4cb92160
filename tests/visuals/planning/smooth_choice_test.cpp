#include "visuals/planning/smooth_choice.h"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <numeric>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;

namespace {

std::vector<int> given(std::vector<planning::SmoothCandidate> aircraft, int smooth) {
    std::vector<int> result(aircraft.size(), -1);
    planning::distribute_smooth(aircraft, smooth, result);
    return result;
}

/// A box of six polygons 20 m ahead.
struct Box {
    planning::Scene scene;
    scene::Settings settings = plain_settings();
    scene::Camera camera = scene::camera_looking_at({0, 0, 50}, {100, 0, 50});

    Box() {
        scene.ground = cell_ground(4, 100.0, [](double, double) { return 0.0; });
        scene.add_model(convex_aircraft(box_model({1, 1, 1})));
        scene.aircraft = {0};
    }

    struct Shown {
        int counted = 0;
        int bits = 0;
    };

    Shown shown(const planning::SmoothTarget& smooth_target = {}) {
        planning::Planner planner(scene, settings);
        const std::array there{state_at({20, 0, 50})};
        const auto [plan, counts] = planner.plan({.camera = camera, .states = there, .smooth = smooth_target});
        return {counts.smooth_polygons, std::popcount(plan.smooth.at(0) & 0x3fU)};
    }
};

} // namespace

TEST_CASE("an aircraft that has all it can take leaves the rest to one that weighs next to nothing") {
    CHECK(given({{.polygons = 5, .weight = 1e12}, {.polygons = 50, .weight = 1e-3}}, 30) == std::vector<int>{5, 25});
}

TEST_CASE("smooth polygons are shared out by weight, and what one cannot take others get") {
    CHECK(given({{100, 1.0}, {100, 1.0}}, 50) == std::vector<int>{25, 25});
    CHECK(given({{100, 3.0}, {100, 1.0}}, 80) == std::vector<int>{60, 20});
    CHECK(given({{10, 3.0}, {100, 1.0}}, 80) == std::vector<int>{10, 70});
    CHECK(given({{10, 1.0}, {10, 1.0}}, 50) == std::vector<int>{10, 10});
    CHECK(given({{10, 0.0}, {10, 0.0}}, 5) == std::vector<int>{5, 0});
    CHECK(given({{7, 1.0}, {7, 1.0}, {7, 1.0}}, 11) == std::vector<int>{5, 3, 3});
    CHECK(given({}, 3).empty());
}

TEST_CASE("what is shared out is what was asked for, or all there is") {
    PlaceDice dice(4);
    for (int trial = 0; trial < 500; ++trial) {
        std::vector<planning::SmoothCandidate> aircraft;
        int all = 0;
        for (int i = 0; i < 5; ++i) {
            aircraft.push_back({static_cast<int>(dice.between(0, 200)), dice.between(0, 3)});
            all += aircraft.back().polygons;
        }
        const int asked = static_cast<int>(dice.between(0, 1200));
        const std::vector<int> got = given(aircraft, asked);
        CHECK(std::accumulate(got.begin(), got.end(), 0) == std::min(asked, all));
        for (std::size_t i = 0; i < got.size(); ++i) { CHECK(got[i] <= aircraft[i].polygons); }
    }
}

TEST_CASE("shading flat, gouraud and hybrid by a share are bits of the plan") {
    Box box;
    box.settings.shading.kind = scene::AircraftShading::Flat;
    CHECK(box.shown().bits == 0);
    box.settings.shading.kind = scene::AircraftShading::Gouraud;
    CHECK(box.shown().bits == 6);
    CHECK(box.shown().counted == 6);
    box.settings.shading.kind = scene::AircraftShading::Hybrid;
    CHECK(box.shown().bits == 6);
    box.settings.shading.smooth_share = 0.5;
    CHECK(box.shown().bits == 3);
    CHECK(box.shown().counted == 3);
    CHECK(box.shown({.polygons = 2, .share = {}}).bits == 2);
    CHECK(box.shown({.polygons = 5, .share = {}}).bits == 5);
}

TEST_CASE("a frame's share goes before the settings' own, a number before both") {
    Box box;
    box.settings.shading.smooth_share = 0.5;
    CHECK(box.shown({.polygons = {}, .share = 1.0 / 3.0}).counted == 2);
    CHECK(box.shown({.polygons = 5, .share = 1.0 / 3.0}).counted == 5);
    CHECK(box.shown().counted == 3);
}

TEST_CASE("models show their shading and their levels by tints, but for refined ones their levels") {
    Box box;
    const auto tints = [&](scene::ModelDisplay look) {
        box.settings.shading.show_model = look;
        planning::Planner planner(box.scene, box.settings);
        const std::array there{state_at({20, 0, 50})};
        return planner.plan({box.camera, there}).plan.aircraft.at(0).tints;
    };
    CHECK(tints(scene::ModelDisplay::None).smooth == 0);
    CHECK(tints(scene::ModelDisplay::None).flat == 0);
    CHECK(tints(scene::ModelDisplay::Shading).smooth == planning::shading_tints.smooth);
    CHECK(tints(scene::ModelDisplay::Shading).flat == planning::shading_tints.flat);
    CHECK(tints(scene::ModelDisplay::Levels).flat == planning::level_colour(0.0, 1.0));
}

TEST_CASE("the paper's rule shades less smoothly the farther away") {
    Box box;
    box.settings.shading.rule = scene::HybridRule::Paper;
    box.settings.shading.far_m = 40.0;
    CHECK(box.shown().bits == 3); // half way
    box.settings.shading.far_m = 10.0;
    CHECK(box.shown().bits == 0);
    box.settings.shading.near_m = 30.0;
    box.settings.shading.far_m = 40.0;
    CHECK(box.shown().bits == 6);
}
