#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "plan_painter.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::landscape;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

namespace {

double rugged(double x_m, double y_m) {
    return 60.0 * std::sin(x_m / 90.0) * std::cos(y_m / 70.0) + 25.0 * std::sin(x_m / 31.0 + y_m / 23.0);
}

struct Total {
    int seen = 0;
    int wrong = 0;
    int cuts = 0;
    int overlap_groups = 0;
    int unordered = 0;

    void check_right(int min_seen) const {
        CHECK(seen > min_seen);
        CHECK(wrong == 0);
        CHECK(unordered == 0);
    }
};

using PlaceChoice = std::function<glm::dvec3(PlaceDice&)>;

/// Within a box around a place so high.
PlaceChoice around(const glm::dvec3& half_m, double height_m) {
    return [=](PlaceDice& dice) { return dice.in_box(half_m) + glm::dvec3(0, 0, height_m); };
}

/// Above the ridges, within a square around the middle.
PlaceChoice over_ridges(double half_m, double min_m, double max_m) {
    return [=](PlaceDice& dice) {
        const glm::dvec3 at = dice.in_box({half_m, half_m, 0});
        return glm::dvec3(at.x, at.y, rugged(at.x, at.y) + dice.between(min_m, max_m));
    };
}

/// Boxes and concave bodies where `place` puts them, seen from `eye`.
Total paint_scenes(int scenes, int aircraft, std::shared_ptr<const Ground> ground, const PlaceChoice& place,
    const PlaceChoice& eye, const Settings& settings = plain_settings()) {
    Total total;
    PlaceDice dice(1989);
    Scene scene =
        small_scene({convex_aircraft(box_model({10.0, 3.0, 2.0})), concave_aircraft(0.1)}, {}, std::move(ground));
    for (int i = 0; i < aircraft; ++i) { scene.aircraft.push_back(static_cast<std::uint32_t>(i % 2)); }
    Planner planner(scene, settings);
    for (int i = 0; i < scenes; ++i) {
        std::vector<sim::AircraftState> states;
        for (int k = 0; k < aircraft; ++k) { states.push_back(state_at(place(dice), dice.attitude())); }
        Camera camera = camera_looking_at(eye(dice), states.front().position_m);
        camera.near_m = 1e-3;
        const auto [plan, counts] = planner.plan({camera, states});
        const SightCount count = count_wrong_sights(plan, scene, states, camera, dice);
        if (count.wrong > 0) {
            INFO("scene " << i);
            CHECK(count.wrong == 0);
        }
        total.seen += count.seen;
        total.wrong += count.wrong;
        total.cuts += counts.cuts;
        total.overlap_groups += counts.overlap_groups;
        total.unordered += counts.unordered;
    }
    return total;
}

std::shared_ptr<const Ground> cells(const Height& height) { return cell_ground(16, 50.0, height); }

const Height level = [](double, double) { return 0.0; };

} // namespace

TEST_CASE("aircraft apart over level ground are painted right without repaints") {
    const Total total =
        paint_scenes(100, 6, cells(level), around({300, 300, 60}, 100.0), around({350, 350, 60}, 100.0));
    total.check_right(10000);
    CHECK(total.cuts == 0);
}

TEST_CASE("aircraft among ridges are painted right") {
    const Total total =
        paint_scenes(100, 5, cells(rugged), over_ridges(300.0, 18.0, 60.0), over_ridges(380.0, 3.0, 60.0));
    total.check_right(10000);
    CHECK(total.cuts > 100);
}

TEST_CASE("aircraft that touch the ground are painted right") {
    const Total total =
        paint_scenes(100, 3, cells(rugged), over_ridges(300.0, -2.0, 8.0), over_ridges(380.0, 3.0, 60.0));
    total.check_right(5000);
    CHECK(total.overlap_groups > 50);
}

TEST_CASE("aircraft close together, in rings and through each other are painted right") {
    for (const double spread_m : {8.0, 15.0, 30.0}) {
        const Total total =
            paint_scenes(60, 5, cells(rugged), around(glm::dvec3(spread_m), 150.0), around({120, 120, 60}, 150.0));
        total.check_right(5000);
        CHECK(total.overlap_groups > 10);
    }
}

TEST_CASE("27 aircraft in any attitudes 20 m apart are painted right") {
    int next = 0;
    const Total total = paint_scenes(
        30, 27, cells(level),
        [&](PlaceDice& /*dice*/) {
            const int i = next++;
            return 20.0 * glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 % 3 + 4);
        },
        around({70, 70, 40}, 100.0));
    total.check_right(10000);
    CHECK(total.overlap_groups > 30);
    CHECK(total.cuts > 0);
}

TEST_CASE("125 aircraft in any attitudes 20 m apart are planned without giving up") {
    Scene scene = small_scene({convex_aircraft(box_model({9.7, 6.5, 2.2})), concave_aircraft(0.1)}, {}, cells(level));
    PlaceDice dice(1989);
    std::vector<sim::AircraftState> states;
    for (int i = 0; i < 125; ++i) {
        scene.aircraft.push_back(static_cast<std::uint32_t>(i % 2));
        states.push_back(state_at(20.0 * glm::dvec3(i % 5, i / 5 % 5, i / 25 + 4), dice.attitude()));
    }
    const Settings settings = plain_settings();
    Planner planner(scene, settings);
    const Camera camera = camera_looking_at({-120, -90, 140}, {40, 40, 120});
    const PlanCounts counts = planner.plan({camera, states}).counts;
    CHECK(counts.unordered == 0);
    CHECK(counts.overlap_groups > 1);
    CHECK(counts.cuts < 500);
}

TEST_CASE("a heap of aircraft that meet in thousands of places is drawn by depth, each once") {
    constexpr int count = 60;
    const Scene scene =
        small_scene({convex_aircraft(box_model({9.7, 6.5, 2.2}))}, std::vector<std::uint32_t>(count, 0), cells(level));
    PlaceDice dice(1989);
    std::vector<sim::AircraftState> states;
    for (int i = 0; i < count; ++i) {
        states.push_back(state_at(glm::dvec3(0, 0, 120) + dice.in_box({4, 4, 4}), dice.attitude()));
    }
    const Settings settings = plain_settings();
    Planner planner(scene, settings);
    const auto [plan, counts] = planner.plan({camera_looking_at({-120, -90, 140}, {0, 0, 120}), states});
    CHECK(counts.unordered == count);
    CHECK(counts.cuts == 0);
    CHECK(plan.clips.empty());
    CHECK(plan.depth_boxes.size() == 1);
    REQUIRE(plan.aircraft.size() == count);
    const auto drawn = [](const PaintStep& step) { return step.content == PaintStep::Content::Aircraft; };
    CHECK(std::ranges::count_if(plan.steps, drawn) == 1);
    const auto heap = std::ranges::find_if(plan.steps, drawn);
    REQUIRE(heap != plan.steps.end());
    CHECK(heap->count == count);
    CHECK(heap->depth == DepthUse::Nearest);
}

TEST_CASE("ground before a group stays behind what is seen between the members") {
    // Two bars meet in a corner. Before the box around both stands a wall, before it a small box that is painted first,
    // as its sphere is farther than theirs.
    const Scene scene = small_scene({convex_aircraft(box_model({50, 1, 1})), convex_aircraft(box_model({1, 1, 50})),
                                        convex_aircraft(box_model({1, 1, 1}))},
        {0, 1, 2}, triangle_ground({{{{20, 7, 20}, {100, 7, 20}, {20, 7, 100}}}}));
    const std::vector states = {state_at({50, 11, 0}), state_at({0, 11, 50}), state_at({40, 5, 40})};
    const Settings settings = plain_settings();
    Planner planner(scene, settings);
    const Camera camera = camera_looking_at({0, 0, 0}, states[2].position_m);
    const auto [plan, counts] = planner.plan({camera, states});
    REQUIRE(counts.overlap_groups == 1);
    CHECK(plan.aircraft.front().model == 2);
    PlaceDice dice(1);
    const SightCount count = count_wrong_sights(plan, scene, states, camera, dice);
    CHECK(count.seen > 50);
    CHECK(count.wrong == 0);
}

TEST_CASE("27 aircraft in any attitudes among ridges are painted right") {
    int next = 0;
    const Total total = paint_scenes(
        30, 27, cells(rugged),
        [&](PlaceDice& /*dice*/) {
            const int i = next++;
            const glm::dvec3 at = 21.0 * glm::dvec3(i % 9 - 4, i / 9 % 3 - 1, 0);
            return glm::dvec3(at.x, at.y, rugged(at.x, at.y) + 9.0);
        },
        over_ridges(250.0, 3.0, 30.0));
    total.check_right(10000);
    CHECK(total.overlap_groups > 30);
}

TEST_CASE("aircraft among ridges are painted right over a quadtree's ground") {
    std::vector<float> heights_m;
    for (int row = 0; row < 65; ++row) {
        for (int column = 0; column < 65; ++column) {
            heights_m.push_back(static_cast<float>(rugged((column - 32) * 12.5, (row - 32) * 12.5)));
        }
    }
    Settings settings = plain_settings();
    settings.ground.triangles = 600;
    settings.ground.lod.metric = octant::visuals::terrain::GroundMetric::Midpoint;
    const Total total = paint_scenes(60, 5, make_field_ground({65, 65, 12.5, heights_m}, settings.ground, settings.air),
        over_ridges(300.0, 0.0, 60.0), over_ridges(380.0, 3.0, 60.0), settings);
    total.check_right(5000);
    CHECK(total.cuts > 100);
}
