#include "visuals/planning/id_plan.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "plan_painter.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

namespace {

constexpr double clouds_m = 150.0;

double below_clouds_m(double x_m, double y_m) { return 60.0 * std::sin(x_m / 90.0) * std::cos(y_m / 70.0); }

Settings cloudy() {
    Settings settings = plain_settings();
    settings.air.clouds = 0.7;
    settings.air.cloud_height_m = clouds_m;
    return settings;
}

Scene scene_of(int aircraft) {
    Scene scene;
    scene.ground = cell_ground(16, 60.0, below_clouds_m);
    scene.add_model(convex_aircraft(box_model({10.0, 3.0, 2.0})));
    scene.aircraft.assign(static_cast<std::size_t>(aircraft), 0);
    return scene;
}

glm::dvec3 in_the_air(PlaceDice& dice) { return dice.in_box({300.0, 300.0, 110.0}) + glm::dvec3(0.0, 0.0, 190.0); }

} // namespace

TEST_CASE("with clouds between them ground and aircraft are painted in the right order") {
    PlaceDice dice(77);
    const Scene scene = scene_of(6);
    const Settings settings = cloudy();
    Planner planner(scene, settings);
    int seen = 0;
    int wrong = 0;
    for (int i = 0; i < 60; ++i) {
        std::vector<sim::AircraftState> states;
        for (int k = 0; k < 6; ++k) { states.push_back(state_at(in_the_air(dice), dice.attitude())); }
        Camera camera = camera_looking_at(in_the_air(dice), states.front().position_m);
        camera.near_m = 1e-3;
        const auto [plan, counts] = planner.plan({camera, states});
        const SightCount count = count_wrong_sights(plan, scene, states, camera, dice);
        seen += count.seen;
        wrong += count.wrong;
    }
    CHECK(seen > 1000);
    CHECK(wrong == 0);
}

TEST_CASE("clouds come after what lies beyond them and before what lies on the eye's side") {
    const Scene scene = scene_of(2);
    const Settings settings = cloudy();
    Planner planner(scene, settings);
    const std::vector<sim::AircraftState> states{state_at({0.0, 200.0, 110.0}), state_at({20.0, 200.0, 190.0})};
    for (const double eye_m : {100.0, 400.0}) {
        const Camera camera = camera_looking_at({0.0, -200.0, eye_m}, states.front().position_m);
        const auto [plan, counts] = planner.plan({camera, states});
        const auto& steps = plan.steps;
        const auto step = [&](PaintStep::Content content) {
            return std::ranges::find(steps, content, &PaintStep::content) - steps.begin();
        };
        const auto clouds = step(PaintStep::Content::Transparent);
        REQUIRE(static_cast<std::size_t>(clouds) < plan.steps.size());
        CHECK((step(PaintStep::Content::Ground) < clouds) == (eye_m > clouds_m));
        const auto first = step(PaintStep::Content::Aircraft);
        CHECK(first < clouds); // the one beyond
        const std::uint32_t beyond = plan.aircraft[plan.steps[static_cast<std::size_t>(first)].first].first_part;
        CHECK(beyond == (eye_m > clouds_m ? 0U : 1U));
        CHECK(counts.transparent_triangles > 0);
        CHECK(plan.overlay.indices.size() == 3 * static_cast<std::size_t>(counts.transparent_triangles));
    }
}

TEST_CASE("pictures of numbers have no clouds, and without clouds nothing is seen through") {
    const Scene scene = scene_of(1);
    const std::vector<sim::AircraftState> states{state_at({0.0, 0.0, 100.0})};
    const Camera camera = camera_looking_at({0.0, -200.0, 60.0}, states.front().position_m);
    Settings settings = cloudy();
    Planner cloudy_planner(scene, settings);
    IdPlan ids(scene);
    const FramePlan& numbers = ids.of(cloudy_planner.plan({camera, states}).plan);
    CHECK(std::ranges::count(numbers.steps, PaintStep::Content::Transparent, &PaintStep::content) == 0);
    const Settings clear = plain_settings();
    Planner planner(scene, clear);
    const auto [plan, counts] = planner.plan({camera, states});
    CHECK(counts.transparent_triangles == 0);
    CHECK(std::ranges::count(plan.steps, PaintStep::Content::Transparent, &PaintStep::content) == 0);
}
