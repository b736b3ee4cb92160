#include "sim/base/error.h"
#include "visuals/planning/id_plan.h"

#include <catch2/catch.hpp>

#include <array>
#include <set>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
namespace refine = octant::visuals::refine;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;

namespace {

/// A tetrahedron with its sides outwards.
models::TriangleMesh tetrahedron() {
    models::TriangleMesh mesh;
    mesh.name = "tetrahedron";
    mesh.vertices_m = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

planning::Scene scene_of(planning::AircraftModel model) {
    planning::Scene world;
    world.ground = cell_ground(4, 100.0, [](double, double) { return 0.0; });
    world.add_model(std::move(model));
    world.aircraft = {0, 0};
    return world;
}

/// Colours of the corners that begin the triangles of a range.
void add_numbers(const scene::ModelBuffers& buffers, const scene::IndexRange& range, std::set<std::uint32_t>& numbers) {
    for (std::uint32_t i = 0; i < range.index_count; i += 3) {
        numbers.insert(buffers.vertices[buffers.indices[range.first_index + i]].face_colour);
    }
}

} // namespace

TEST_CASE("every polygon and every triangle of a level has a number, of each aircraft its own") {
    planning::AircraftModel model = convex_aircraft(box_model({1, 1, 1}));
    const models::TriangleMesh fine = tetrahedron();
    const models::TriangleMesh coarse = tetrahedron();
    const std::array<planning::MeshSource, 2> sources{{{&fine, 0.0}, {&coarse, 0.1}}};
    planning::add_levels(model, sources, 0.5);
    const planning::Scene world = scene_of(std::move(model));
    const planning::IdPlan ids(world);
    REQUIRE(ids.models().size() == 2);
    std::set<std::uint32_t> numbers;
    for (const scene::ModelBuffers& buffers : ids.models()) {
        add_numbers(buffers, world.models[0]->file_order, numbers);
        for (const planning::MeshLevel& level : world.models[0]->levels) { add_numbers(buffers, level.range, numbers); }
    }
    CHECK(numbers.size() == 2 * (6 + 4 + 4));
}

TEST_CASE("a plan of numbers has no smooth polygon and no tint") {
    const planning::Scene world = scene_of(convex_aircraft(box_model({1, 1, 1})));
    planning::IdPlan ids(world);
    scene::FramePlan plan;
    plan.smooth = {~0U};
    plan.aircraft = {{.model = 0, .tints = planning::shading_tints}};
    const scene::FramePlan& numbered = ids.of(plan);
    CHECK(numbered.smooth == std::vector<std::uint32_t>{0U});
    CHECK(numbered.aircraft[0].tints.smooth == 0);
    CHECK(numbered.aircraft[0].tints.flat == 0);
}

TEST_CASE("a mesh that is refined in each frame has no numbers, and the refusal says so") {
    planning::AircraftModel model = convex_aircraft(box_model({1, 1, 1}));
    models::CollapseSequence sequence;
    sequence.original = tetrahedron();
    planning::add_progressive(model, std::make_shared<const refine::ProgressiveMesh>(sequence), 0.5);
    const planning::Scene world = scene_of(std::move(model));
    CHECK_THROWS_AS(planning::IdPlan(world), Error);
}
