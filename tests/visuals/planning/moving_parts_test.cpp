#include "sim/base/axes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

TEST_CASE("a turning part's matrix puts its points where the pivot has turned them to") {
    models::polygons::PolygonModel model = box_model({4.0, 1.0, 1.0});
    model.parts.emplace_back("top");
    model.polygons[5].part = 1;
    model.pivots.push_back({1, {0.5, 0.0, -1.0}, {0.0, 0.0, 1.0}, 0.3});
    Scene scene = small_scene({convex_aircraft(box_model({1, 1, 1})), convex_aircraft(model)}, {0, 1, 1});
    const AircraftModel& aircraft = *scene.models[1];
    for (std::size_t i = 0; i < aircraft.buffers.vertices.size(); ++i) {
        CHECK(aircraft.buffers.vertices[i].part == (i / 4 == 5 ? 1U : 0U));
    }

    const Settings settings = plain_settings();
    Planner planner(scene, settings);
    const glm::dquat attitude = body_to_world_from_euler({0.7, 0.2, -0.4});
    std::vector<sim::AircraftState> states = {
        state_at({0, 90, 0}), state_at({5, 30, 2}, attitude), state_at({-20, 60, 0})};
    states[1].time_s = 12.5;
    const Camera camera = camera_looking_at({1, 2, 3}, {0, 50, 0});
    const FramePlan& plan = planner.plan({camera, states}).plan;
    REQUIRE(plan.parts.size() == 5);
    REQUIRE(plan.aircraft.size() == 3);
    const AircraftDraw& nearest = plan.aircraft.back();
    REQUIRE(nearest.model == 1);
    const glm::dvec3 point_m(3.0, -0.5, 1.0);
    const glm::dvec3 turned_m = models::polygons::turned(model.pivots[0], point_m, 2.0 * 3.14159265358979 * 0.3 * 12.5);
    const auto placed = [&](const glm::dvec3& body_m, std::uint32_t part) {
        return glm::dvec3(plan.parts[nearest.first_part + part] * glm::vec4(glm::vec3(body_m), 1));
    };
    const glm::dvec3 expected_m = states[1].position_m + attitude * turned_m - camera.eye_m;
    CHECK(glm::distance(placed(point_m, 1), expected_m) < 1e-4);
    CHECK(glm::distance(placed(turned_m, 0), expected_m) < 1e-4);
    // All three in one step that is not cut: there is neither sky nor ground.
    REQUIRE(plan.steps.size() == 1);
    CHECK(plan.steps[0].count == 3);
    CHECK(plan.steps[0].clip == PaintStep::no_clip);
}

TEST_CASE("a far model stands in by distance, and others turn its part of the same name") {
    models::polygons::PolygonModel near_by = box_model({4.0, 1.0, 1.0});
    near_by.parts = {"body", "rotor", "tail"};
    near_by.pivots = {{1, {0, 0, -1}, {0, 0, 1}, 0.0}, {2, {-2, 0, 0}, {0, 1, 0}, 0.0}};
    models::polygons::PolygonModel far_off = near_by;
    far_off.parts = {"body", "tail", "rotor"};
    std::swap(far_off.pivots[0], far_off.pivots[1]);
    far_off.pivots[0].part = 1;
    far_off.pivots[1].part = 2;
    Scene scene = small_scene({convex_aircraft(near_by), convex_aircraft(far_off)}, {0});
    scene.far_models = {{0, 1, 0.1}};
    const double quarter_rad = 0.5 * 3.14159265358979;
    const std::vector<ArticulatedPart> turned = {{0, 0, glm::angleAxis(quarter_rad, glm::dvec3(0.0, 0.0, 1.0))}};
    const Settings settings = plain_settings();
    Planner planner(scene, settings);
    for (const auto& [away_m, model, rotor] : {std::tuple{30.0, 0U, 1U}, std::tuple{30000.0, 1U, 2U}}) {
        const std::vector<sim::AircraftState> states = {state_at({0, away_m, 0})};
        PlanRequest request{camera_looking_at({0, 0, 0}, {0, away_m, 0}), states};
        request.articulated_parts = turned;
        const FramePlan& plan = planner.plan(request).plan;
        REQUIRE(plan.aircraft.size() == 1);
        const AircraftDraw& drawn = plan.aircraft.front();
        CHECK(drawn.model == model);
        const auto tip = [&](std::uint32_t part) {
            const glm::vec4 at = plan.parts[drawn.first_part + part] * glm::vec4(1, 0, -1, 1);
            return glm::dvec3(at) - states.front().position_m;
        };
        const glm::dvec3 still = tip(0);
        CHECK(glm::distance(tip(rotor), still) > 1.0);
        CHECK(glm::distance(tip(3 - rotor), still) < 0.02);
    }
}

TEST_CASE("a far model is drawn only where its distance from the near one is not seen") {
    Scene scene =
        small_scene({convex_aircraft(box_model({4.0, 1.0, 1.0})), convex_aircraft(box_model({4.0, 1.0, 0.5}))}, {0});
    constexpr double error_m = 0.5;
    scene.far_models = {{0, 1, error_m}};
    const Settings settings = plain_settings();
    Planner planner(scene, settings);
    const Camera camera;
    const double pixel_rad = 2.0 * std::tan(camera.vertical_fov_rad / 2.0) / settings.view.size_px.y;
    const double radius_m = scene.models[0]->subject.radius_m;
    int far = 0;
    int changes = 0;
    for (int step = 0; step <= 400; ++step) { // off and back again
        const double away_m = 20.0 * std::pow(1.03, step <= 200 ? step : 400 - step);
        const std::vector states{state_at({0, away_m, 0})};
        const FramePlan& plan = planner.plan({camera_looking_at({0, 0, 0}, {0, away_m, 0}), states}).plan;
        REQUIRE(plan.aircraft.size() == 1);
        const bool is_far = plan.aircraft.front().model == 1;
        changes += step > 0 && is_far != (far == step) ? 1 : 0;
        far = is_far ? step + 1 : 0;
        const double seen_px = error_m / ((away_m - radius_m) * pixel_rad);
        if (is_far) { CHECK(seen_px <= settings.surface.aircraft_error_px); }
        if (seen_px < 0.5 * settings.surface.aircraft_error_px) { CHECK(is_far); }
    }
    CHECK(changes == 2);
}

TEST_CASE("aircraft whose models change are placed as by a planner that never saw them before") {
    models::polygons::PolygonModel turning = box_model({4.0, 1.0, 1.0});
    turning.parts = {"body", "rotor", "tail"};
    turning.pivots = {{1, {0, 0, -1}, {0, 0, 1}, 3.0}, {2, {-2, 0, 0}, {0, 1, 0}, 5.0}};
    turning.polygons[5].part = 1;
    turning.polygons[0].part = 2;
    Scene scene = small_scene({convex_aircraft(turning), convex_aircraft(box_model({4.0, 1.0, 1.0}))}, {1, 0, 0});
    scene.far_models = {{0, 1, 0.1}, {1, 0, 0.1}}; // one loses its pivots, one gets some
    const Settings settings = plain_settings();
    Planner flown(scene, settings);
    for (const double away_m : {30.0, 30000.0, 40.0, 20000.0, 30.0}) {
        std::vector<sim::AircraftState> states{
            state_at({0, away_m, 0}), state_at({0, 1.5 * away_m, 0}), state_at({9, 60, 0})};
        for (sim::AircraftState& state : states) { state.time_s = away_m / 7.0; }
        Planner fresh(scene, settings);
        const Camera camera = camera_looking_at({0, 0, 0}, {0, away_m, 0});
        const FramePlan& expected = fresh.plan({camera, states}).plan;
        const FramePlan& plan = flown.plan({camera, states}).plan;
        REQUIRE(plan.aircraft.size() == expected.aircraft.size());
        for (std::size_t i = 0; i < plan.aircraft.size(); ++i) {
            const AircraftDraw& drawn = plan.aircraft[i];
            INFO(away_m << " m, draw " << i);
            REQUIRE(drawn.model == expected.aircraft[i].model);
            REQUIRE(drawn.first_part == expected.aircraft[i].first_part);
            CHECK(drawn.first_index == expected.aircraft[i].first_index);
            CHECK(drawn.index_count == expected.aircraft[i].index_count);
            const std::size_t parts = scene.models[drawn.model]->polygons.pivots.size() + 1;
            for (std::size_t part = drawn.first_part; part < drawn.first_part + parts; ++part) {
                CHECK(plan.parts[part] == expected.parts[part]);
            }
        }
    }
}

TEST_CASE("a part that somebody moves lies so far along the body's axes, and turns there") {
    models::polygons::PolygonModel model = box_model({4.0, 1.0, 1.0});
    model.parts = {"body", "store"};
    model.polygons[5].part = 1;
    model.pivots.push_back({1, {0.5, 0.0, 1.0}, {1.0, 0.0, 0.0}, 0.0});
    Scene scene = small_scene({convex_aircraft(model)}, {0});
    const double quarter_rad = 0.5 * 3.14159265358979;
    const std::vector<ArticulatedPart> turned = {
        {0, 0, glm::angleAxis(quarter_rad, glm::dvec3(1.0, 0.0, 0.0)), {-2.0, 3.0, 0.5}}};
    const Settings settings = plain_settings();
    Planner planner(scene, settings);
    const glm::dquat attitude = body_to_world_from_euler({0.7, 0.2, -0.4});
    const std::vector<sim::AircraftState> states = {state_at({0, 30, 0}, attitude)};
    PlanRequest request{camera_looking_at({1, 2, 3}, {0, 30, 0}), states};
    request.articulated_parts = turned;
    const FramePlan& plan = planner.plan(request).plan;
    const glm::vec4 at = plan.parts[plan.aircraft.front().first_part + 1] * glm::vec4(1, 0, 2, 1);
    // One below the pivot becomes one to its left: y is right and z is down.
    const glm::dvec3 body_m = glm::dvec3(1.0, -1.0, 1.0) + turned.front().offset_m;
    const glm::dvec3 expected_m = states[0].position_m + attitude * body_m - request.camera.eye_m;
    CHECK(glm::distance(glm::dvec3(at), expected_m) < 1e-4);
}

TEST_CASE("with a depth buffer one step draws the aircraft from the nearest") {
    Scene scene = small_scene({convex_aircraft(box_model({1, 1, 1}))}, {0, 0, 0});
    Settings settings = plain_settings();
    settings.surface.hidden_surface = HiddenSurface::DepthBuffer;
    Planner planner(scene, settings);
    const std::vector states{state_at({0, 30, 0}), state_at({0, 90, 0}), state_at({0, 60, 0})};
    const FramePlan& plan = planner.plan({Camera(), states}).plan;
    REQUIRE(plan.steps.size() == 2);
    CHECK(plan.steps[0].content == PaintStep::Content::ClearDepth);
    CHECK(plan.depth_boxes.at(0).max == settings.view.size_px);
    CHECK(plan.steps[1].content == PaintStep::Content::Aircraft);
    CHECK(plan.steps[1].count == 3);
    CHECK(plan.steps[1].depth == DepthUse::Nearest);
    REQUIRE(plan.aircraft.size() == 3);
    CHECK(plan.aircraft[0].first_part == 0);
    CHECK(plan.aircraft[1].first_part == 2);
    CHECK(plan.aircraft[2].first_part == 1);
}
