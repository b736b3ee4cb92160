#include "visuals/planning/transparents.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "plan_painter.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

namespace {

/// East at 50 m/s, 200 m up, from 500 m west to 500 m east, in two legs.
DrawnPath eastward() {
    std::vector<sim::AircraftState> samples;
    for (int i = 0; i <= 20; ++i) {
        samples.push_back(state_at({-500.0 + 50.0 * i, 0.0, 200.0}));
        samples.back().time_s = i;
        samples.back().velocity_mps = {50.0, 0.0, 0.0};
    }
    const std::vector<NamedTime> legs{{0.0, "out"}, {12.0, "on"}};
    return drawn_path(sim::Trajectory(samples), legs);
}

constexpr glm::dvec3 view_eye_m(0.0, -600.0, 260.0);
constexpr double ribbon_time_s = 10.0; ///< the aircraft is in the middle

Scene scene_with_path(const glm::dvec3& aircraft_half_m) {
    Scene scene;
    // A ridge between the eyes and the path, with gaps in it.
    scene.ground = cell_ground(16, 60.0, [](double x_m, double y_m) {
        return std::abs(y_m + 150.0) < 40.0 ? 190.0 + 60.0 * std::sin(x_m / 90.0) : 40.0;
    });
    scene.add_model(convex_aircraft(box_model(aircraft_half_m)));
    scene.path = std::make_shared<const DrawnPath>(eastward());
    return scene;
}

Settings settings_with_ribbon() {
    Settings settings = plain_settings();
    settings.view.path_ribbon = true;
    return settings;
}

/// The dashes as that eye sees them, with the aircraft somewhere else on the path.
struct SeenRibbon {
    Scene scene = scene_with_path({11.0, 3.0, 2.0});
    Settings settings = settings_with_ribbon();
    FramePlan plan;
    Transparents transparents{scene, settings, visuals::nature::Daylight({})};

    explicit SeenRibbon(double time_s = ribbon_time_s) {
        scene.aircraft = {0};
        const Camera camera = camera_looking_at(view_eye_m, {0.0, 0.0, 200.0});
        plan.world_to_view = world_to_view(camera);
        plan.view_to_clip = view_to_clip(camera, 2.0);
        plan.haze = {};
        std::array states{state_at({50.0 * (time_s - 10.0), 0.0, 200.0})};
        states.front().time_s = time_s;
        const FrameView view = frame_view(camera, {800, 400}, 0.0);
        const PlanRequest request{camera, states};
        Fleet fleet(scene, settings);
        fleet.place(view, request, std::array{std::optional<AxisAlignedBox>()});
        transparents.make(view, request, fleet, plan);
    }
};

} // namespace

TEST_CASE("a path has points at even times, and its legs begin at them") {
    const DrawnPath path = eastward();
    REQUIRE(path.points.size() == 201);
    CHECK(path.time_s(200) == Approx(20.0));
    CHECK(path.points[100].position_m.x == Approx(0.0).margin(1e-6));
    REQUIRE(path.legs.size() == 2);
    CHECK(path.legs[1].first_point == 120);
    CHECK(path.legs[1].name == "on");
}

TEST_CASE("dashes of a ribbon do not meet each other and leave the aircraft free") {
    for (const double time_s : {10.0, 10.27, 10.5, 10.8, 10.93}) {
        INFO(time_s);
        const SeenRibbon seen(time_s);
        const auto dashes = seen.transparents.boxes();
        REQUIRE(dashes.size() >= 18);
        for (std::size_t i = 0; i + 1 < dashes.size(); ++i) {
            CHECK(!occlusion_pair(dashes[i], dashes[i + 1]).intersect);
        }
        double nearest_m = 1e9;
        for (const OrientedBox& dash : dashes) {
            const double middle_m = dash.centre_m.x + view_eye_m.x - 50.0 * (time_s - 10.0);
            const double gap_m = std::abs(middle_m) - dash.half_m.x;
            CHECK(gap_m > 19.0); // 1.8 radii of 11.6 m
            nearest_m = std::min(nearest_m, gap_m);
        }
        CHECK(seen.transparents.list().size() == dashes.size());
        CHECK(nearest_m < 32.0);
    }
}

TEST_CASE("what has been flown of a ribbon is stronger, legs differ in colour") {
    const SeenRibbon seen;
    const OverlayDraw draw = seen.transparents.draw();
    const auto colour_of = [&](const Transparent& dash) {
        return draw.vertices[draw.indices[dash.range.first]].colour;
    };
    const std::uint32_t flown = colour_of(seen.transparents.list().front());
    const std::uint32_t coming = colour_of(seen.transparents.list().back());
    CHECK(flown >> 24U > coming >> 24U);
    CHECK((flown & 0xffffffU) != (coming & 0xffffffU));
    for (const OverlayVertex& vertex : draw.vertices) {
        CHECK(vertex.at_px.x > -60.0F);
        CHECK(vertex.at_px.x < 860.0F);
    }
}

TEST_CASE("with a ribbon among them ground and aircraft are painted in the right order") {
    Scene scene = scene_with_path({10.0, 3.0, 2.0});
    scene.aircraft = {0, 0, 0};
    const Settings settings = settings_with_ribbon();
    Planner planner(scene, settings);
    PlaceDice dice(5);
    int seen = 0;
    int wrong = 0;
    int transparents = 0;
    int hidden_again = 0;
    for (int i = 0; i < 40; ++i) {
        std::vector<sim::AircraftState> states{state_at({0.0, 0.0, 200.0}),
            state_at(dice.in_box({300.0, 100.0, 40.0}) + glm::dvec3(0, 0, 220), dice.attitude()),
            state_at(dice.in_box({300.0, 100.0, 40.0}) + glm::dvec3(0, 0, 220), dice.attitude())};
        for (sim::AircraftState& state : states) { state.time_s = ribbon_time_s; }
        Camera camera =
            camera_looking_at(dice.in_box({400.0, 60.0, 30.0}) + glm::dvec3(0, -380, 190), states.front().position_m);
        camera.near_m = 1e-3;
        const auto [plan, counts] = planner.plan({camera, states});
        const SightCount count = count_wrong_sights(plan, scene, states, camera, dice);
        seen += count.seen;
        wrong += count.wrong;
        transparents += counts.transparent_triangles;
        for (std::size_t step = 0; step + 1 < plan.steps.size(); ++step) {
            hidden_again += plan.steps[step].content == PaintStep::Content::Transparent &&
                                    plan.steps[step + 1].content == PaintStep::Content::GroundRepaint
                                ? 1
                                : 0;
        }
    }
    CHECK(seen > 500);
    CHECK(wrong == 0);
    CHECK(transparents > 100);
    CHECK(hidden_again > 10); // ground before a dash is painted once more, right after it
}
