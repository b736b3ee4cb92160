#include "visuals/terrain/bisection_ground_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
namespace landscape = octant::visuals::landscape;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;
namespace terrain = octant::visuals::terrain;

namespace {

models::heights::HeightField rough_field() {
    constexpr int side = 65;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(
                static_cast<float>(40.0 * std::sin(column / 3.0) * std::cos(row / 4.0) + 10.0 * std::sin(row * 1.7)));
        }
    }
    return {side, side, 25.0, heights_m};
}

/// By the paper's quadtree, with a control that remembers earlier frames.
scene::Settings damped() {
    scene::Settings settings = plain_settings();
    settings.ground.lod.control = terrain::DetailControl::Damped;
    settings.ground.triangles = 600;
    return settings;
}

planning::Scene scene_over(std::shared_ptr<const landscape::Ground> ground) {
    planning::Scene scene;
    scene.ground = std::move(ground);
    scene.add_model(convex_aircraft(box_model({1, 1, 1})));
    scene.aircraft = {0};
    return scene;
}

scene::Camera camera_at(int frame) { return scene::camera_looking_at({-600.0 + 20.0 * frame, -500, 200}, {0, 0, 0}); }

/// Triangles of ground in each of the first frames of a flight.
std::vector<int> flown(planning::Planner& planner, const std::function<void()>& between) {
    std::vector<int> triangles;
    const std::array there{state_at({0, 0, 100})};
    planner.settle_detail(camera_at(0));
    for (int frame = 0; frame < 12; ++frame) {
        triangles.push_back(planner.plan({camera_at(frame), there}).counts.ground.triangles);
        between();
    }
    return triangles;
}

/// Planners over the same rough ground, one of which is asked for meshes ahead of time.
struct TwoPlanners {
    scene::Settings settings = plain_settings();
    planning::Scene scene =
        scene_over(landscape::make_bisection_ground(terrain::make_ground_tiles(rough_field()), settings.air));
    planning::Planner ahead{scene, settings};
    planning::Planner at_once{scene, settings};
};

} // namespace

TEST_CASE("a second view of the same ground does not disturb the detail control of the first") {
    const scene::Settings settings = damped();
    const planning::Scene scene =
        scene_over(landscape::make_field_ground(rough_field(), settings.ground, settings.air));
    planning::Planner alone(scene, settings);
    const std::vector<int> expected = flown(alone, [] {});

    scene::Settings coarse = settings;
    coarse.ground.triangles = 100;
    planning::Planner first(scene, settings);
    planning::Planner second(scene, coarse);
    second.settle_detail(scene::camera_looking_at({500, 500, 900}, {0, 0, 0}));
    const std::array there{state_at({0, 0, 100})};
    int of_second = 0;
    const std::vector<int> triangles = flown(first, [&] {
        const scene::Camera above = scene::camera_looking_at({500, 500, 900}, {0, 0, 0});
        of_second = second.plan({above, there}).counts.ground.triangles;
    });
    CHECK(triangles == expected);
    CHECK(of_second > 0);
    CHECK(of_second < 500);
}

TEST_CASE("a planner whose settings are applied anew goes on with its detail") {
    const scene::Settings settings = damped();
    const planning::Scene scene =
        scene_over(landscape::make_field_ground(rough_field(), settings.ground, settings.air));
    planning::Planner alone(scene, settings);
    const std::vector<int> expected = flown(alone, [] {});

    planning::Planner planner(scene, settings);
    CHECK(flown(planner, [&] { planner.apply_settings(); }) == expected);
}

TEST_CASE("meshes made ahead and meshes made when they are asked for are the same") {
    TwoPlanners planners;
    planning::Planner& ahead = planners.ahead;
    planning::Planner& at_once = planners.at_once;
    const std::array there{state_at({0, 0, 100})};
    for (int frame = 0; frame < 6; ++frame) {
        const int target = 300 + 50 * frame;
        ahead.begin_next_mesh(camera_at(frame), target);
        const auto [a, counts_a] = ahead.plan({camera_at(frame), there, target});
        const auto [b, counts_b] = at_once.plan({camera_at(frame), there, target});
        CHECK(counts_a.ground.triangles == counts_b.ground.triangles);
        CHECK(counts_a.ground.triangles <= target);
        CHECK(a.ground.indices.size() == b.ground.indices.size());
    }
}

TEST_CASE("a mesh asked for ahead twice is begun once and leaves the drawn one as it is") {
    TwoPlanners planners;
    planning::Planner& ahead = planners.ahead;
    planning::Planner& at_once = planners.at_once;
    const std::array there{state_at({0, 0, 100})};
    for (int frame = 0; frame < 6; ++frame) {
        const scene::FramePlan& drawn = ahead.plan({camera_at(frame), there, 500}).plan;
        const std::vector<std::uint32_t> indices(drawn.ground.indices.begin(), drawn.ground.indices.end());
        ahead.begin_next_mesh(camera_at(frame + 3), 500);
        ahead.begin_next_mesh(camera_at(frame + 1), 300 + 50 * frame);
        ahead.begin_next_mesh(camera_at(frame + 2), 500);
        ahead.wait();
        CHECK(std::ranges::equal(drawn.ground.indices, indices));
        const scene::FramePlan& expected = at_once.plan({camera_at(frame), there, 500}).plan;
        CHECK(std::ranges::equal(drawn.ground.indices, expected.ground.indices));
    }
}

TEST_CASE("a mesher of tiles goes on over them in other colours, not over others") {
    scene::Settings settings = plain_settings();
    const auto tiles = landscape::make_bisection_ground(terrain::make_ground_tiles(rough_field()), settings.air);
    std::unique_ptr<landscape::GroundMesher> mesher = tiles->mesher(landscape::mesh_settings(settings, false));
    const landscape::GroundMesher* const before = mesher.get();
    const landscape::MeshRequest request{camera_at(0), 1.0, 500};
    landscape::GroundCounts counts;
    mesher->triangles(request, counts);
    mesher->begin_next_mesh({camera_at(1), 1.0, 500}, nullptr);

    settings.air.sun_elevation_deg = 70.0;
    settings.air.palette = scene::Palette::Arid;
    const auto lit = tiles->with_settings(settings.ground, settings.air);
    mesher = landscape::reuse_or_make_mesher(std::move(mesher), *lit, landscape::mesh_settings(settings, false));
    CHECK(mesher.get() == before);
    CHECK(&mesher->ground() == lit.get());
    for (const int frame : {0, 1, 1, 2}) {
        const landscape::MeshRequest next{camera_at(frame), 1.0, 500};
        const scene::TriangleDraw drawn = mesher->triangles(next, counts);
        const auto fresh = lit->mesher(landscape::mesh_settings(settings, false));
        const scene::TriangleDraw expected = fresh->triangles(next, counts);
        const auto colours = [](const scene::TriangleDraw& draw) {
            std::vector<std::uint32_t> each;
            for (const std::uint32_t index : draw.indices) { each.push_back(draw.vertices[index].colour); }
            return each;
        };
        CHECK(colours(drawn) == colours(expected));
    }
    const auto others = landscape::make_bisection_ground(terrain::make_ground_tiles(rough_field()), settings.air);
    CHECK_FALSE(mesher->switch_ground(others));
    CHECK(&mesher->ground() == lit.get());
}

TEST_CASE("ground says which settings it suits and is made anew of its heights for others") {
    scene::Settings settings = damped();
    const auto field = landscape::make_field_ground(rough_field(), settings.ground, settings.air);
    CHECK(field->matches_settings(settings.ground, settings.air));
    settings.ground.triangles = 50;
    settings.view.size_px = {320, 200};
    CHECK(field->matches_settings(settings.ground, settings.air));

    scene::Settings other_sun = settings;
    other_sun.air.sun_elevation_deg = 70.0;
    CHECK_FALSE(field->matches_settings(other_sun.ground, other_sun.air));
    const auto lit = field->with_settings(other_sun.ground, other_sun.air);
    REQUIRE(lit);
    CHECK(lit->matches_settings(other_sun.ground, other_sun.air));
    CHECK(lit->height_at(33.0, -210.0) == field->height_at(33.0, -210.0));
    CHECK(lit->mean_colour() != field->mean_colour());

    const scene::Settings by_error = plain_settings();
    const auto tiles = field->with_settings(by_error.ground, by_error.air);
    REQUIRE(tiles);
    CHECK(tiles->matches_settings(by_error.ground, by_error.air));
    CHECK(*tiles->height_at(33.0, -210.0) == Approx(*field->height_at(33.0, -210.0)).margin(0.01));
    CHECK(tiles->with_settings(settings.ground, settings.air) == nullptr);
}

TEST_CASE("a plan is the same whether its aircraft were placed before it or not") {
    const scene::Settings settings = damped();
    const planning::Scene scene =
        scene_over(landscape::make_field_ground(rough_field(), settings.ground, settings.air));
    planning::Planner at_once(scene, settings);
    planning::Planner in_parts(scene, settings);
    const std::array there{state_at({0, 0, 100})};
    for (int frame = 0; frame < 4; ++frame) {
        const planning::PlanRequest request{camera_at(frame), there};
        in_parts.place_aircraft(request);
        const auto [expected, expected_counts] = at_once.plan(request);
        const auto [plan, counts] = in_parts.plan(request);
        CHECK(counts.ground.triangles == expected_counts.ground.triangles);
        CHECK(plan.parts == expected.parts);
    }
}
