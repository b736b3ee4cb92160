#include "visuals/scene/truth.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <vector>

using namespace octant::visuals::scene;
using octant::models::ColourVertex;
using octant::models::VertexRun;

namespace {

constexpr std::uint32_t land = 0x80808080U;

/// Two triangles of ground, a tree's and a house's on it.
struct SmallPlan {
    std::vector<ColourVertex> vertices{{{0, 10, -5}, land}, {{10, 10, -5}, land}, {{0, 20, -5}, land},
        {{10, 20, -2}, land}, {{1, 11, -5}, 0}, {{2, 11, -5}, 0}, {{1, 12, -3}, 0}, {{3, 11, -5}, 0}, {{4, 11, -5}, 0},
        {{3, 12, -3}, 0}};
    std::vector<std::uint32_t> indices{0, 1, 2, 1, 3, 2, 4, 5, 6, 7, 8, 9};
    std::vector<VertexRun> standing{{4, 7, SurfaceClass::Tree}, {7, 10, SurfaceClass::Building}};
    FramePlan plan;

    SmallPlan() {
        plan.ground = {vertices, indices, standing};
        plan.truth.water.height_m = -5.0F;
    }

    SurfaceClass at(std::size_t triangle) const { return ground_surface(plan, &indices[3 * triangle]); }
};

} // namespace

TEST_CASE("ground is water where it is level and no higher than the water, and what stands on it has its own class") {
    SmallPlan small;
    CHECK(small.at(0) == SurfaceClass::Water);
    CHECK(small.at(1) == SurfaceClass::Terrain);
    CHECK(small.at(2) == SurfaceClass::Tree);
    CHECK(small.at(3) == SurfaceClass::Building);
    small.plan.truth.water.height_m = -6.0F;
    CHECK(small.at(0) == SurfaceClass::Terrain);
    small.plan.truth.water.height_m.reset();
    CHECK(small.at(0) == SurfaceClass::Terrain);
    CHECK(small.at(2) == SurfaceClass::Tree);
}

TEST_CASE("water sinks with the round earth, and a slope below its level is no water") {
    WaterSurface water{-100.0F, 6.4e6F};
    const auto sunk = [&](float x, float y, float above_m = 0.0F) {
        return glm::vec3(x, y, -100.0F + above_m - (x * x + y * y) / (2.0F * 6.4e6F));
    };
    CHECK(is_water(water, {sunk(20000, 0), sunk(21000, 0), sunk(20000, 1000)}));
    CHECK(is_water(water, {sunk(20000, 0, -8), sunk(21000, 0, -5), sunk(20000, 1000, -1)}));
    CHECK(is_water(water, {sunk(20000, 0), sunk(21000, 0, 3.0F), sunk(20000, 1000)}));
    CHECK_FALSE(is_water(water, {sunk(20000, 0), sunk(21000, 0, 30.0F), sunk(20000, 1000)}));
    CHECK_FALSE(is_water(water, {sunk(20000, 0), sunk(21000, 0, 3.0F), sunk(20000, 1000, 3.0F)}));
    CHECK_FALSE(is_water(water, {sunk(200, 0), sunk(300, 0, -2.0F), sunk(200, 100)}));
    water.earth_radius_m = 0.0F;
    CHECK_FALSE(is_water(water, {glm::vec3(0, 0, -99), glm::vec3(10, 0, -100), glm::vec3(0, 10, -100)}));
}

TEST_CASE("a piece on the ground has the class that its corners have, land beyond the map by its covers") {
    SmallPlan small;
    small.plan.shadow_vertices.resize(6);
    small.plan.truth.piece_surfaces = {SurfaceClass::Road, SurfaceClass::Road, SurfaceClass::Road, SurfaceClass::Runway,
        SurfaceClass::Runway, SurfaceClass::Runway};
    const std::array<std::uint32_t, 6> pieces{10, 11, 12, 13, 14, 15};
    CHECK(ground_surface(small.plan, pieces.data()) == SurfaceClass::Road);
    CHECK(ground_surface(small.plan, pieces.data() + 3) == SurfaceClass::Runway);
    const std::vector<ColourVertex> around{
        {{0, 0, 9}, 0}, {{1, 0, 9}, 0}, {{0, 1, 9}, 0}, {{0, 9, -9}, land}, {{9, 9, -9}, 0}, {{0, 19, -9}, 0}};
    small.plan.sky.vertices = around;
    small.plan.truth.first_land_vertex = 3;
    small.plan.truth.land_has_cover_codes = true;
    const std::array<std::uint32_t, 9> sky{0, 1, 2, 3, 4, 5, 3, 3, 4};
    CHECK(sky_surface(small.plan, sky.data()) == SurfaceClass::Sky);
    CHECK(sky_surface(small.plan, sky.data() + 3) == SurfaceClass::Water);
    CHECK(sky_surface(small.plan, sky.data() + 6) == SurfaceClass::Terrain);
}

TEST_CASE("the triangles of a plan are visited once, without what is painted again and without the sky") {
    SmallPlan small;
    ModelBuffers model;
    model.vertices.resize(3);
    model.vertices[1].position_m = {1, 0, 0};
    model.vertices[2].position_m = {0, 1, 0};
    model.indices = {0, 1, 2};
    small.plan.parts = {glm::mat4(1.0F), glm::mat4(2.0F)};
    small.plan.aircraft = {{.model = 0, .index_count = 3, .first_part = 1, .object = 4}};
    small.plan.repaint_indices = {0, 1, 2};
    small.plan.clips.emplace_back();
    small.plan.steps = {{PaintStep::Content::Sky, 0, 0}, {PaintStep::Content::Ground, 0, 12},
        {PaintStep::Content::Aircraft, 0, 1}, {PaintStep::Content::GroundRepaint, 0, 3, 0},
        {PaintStep::Content::GroundRepaint, 0, 3, PaintStep::no_clip, DepthUse::DepthOnly}};
    std::vector<SurfaceTriangle> seen;
    for_each_surface_triangle(
        small.plan, std::span(&model, 1), [&](const SurfaceTriangle& triangle) { seen.push_back(triangle); });
    REQUIRE(seen.size() == 5);
    CHECK(seen[0].surface == SurfaceClass::Water);
    CHECK(seen[3].surface == SurfaceClass::Building);
    CHECK(seen[4].surface == SurfaceClass::Aircraft);
    CHECK(seen[4].object == 4);
    CHECK(seen[4].corners_m[1] == glm::dvec3(2, 0, 0));
}
