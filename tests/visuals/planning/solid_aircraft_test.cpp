#include "visuals/planning/scene_painter.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;
using scene::DepthUse;
using Content = scene::PaintStep::Content;

namespace {

/// A tetrahedron of 1 m around the origin, faces outside.
models::TriangleMesh solid_tetrahedron() {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

/// One aircraft that is a mesh nearer than about 100 m and a box beyond, over level ground.
struct Flight {
    planning::Scene scene;
    scene::Settings settings = plain_settings();
    scene::Camera camera = scene::camera_looking_at({0, 0, 50}, {100, 0, 50});

    Flight() {
        scene.ground = cell_ground(4, 100.0, [](double, double) { return 0.0; });
        planning::AircraftModel model = convex_aircraft(box_model({1, 1, 1}));
        const models::TriangleMesh mesh = solid_tetrahedron();
        const std::array<planning::MeshSource, 1> sources{{{&mesh, 0.0}}};
        planning::add_levels(model, sources, 0.2);
        scene.add_model(std::move(model));
        scene.aircraft = {0};
    }
};

int count(const scene::FramePlan& plan, Content content) {
    return static_cast<int>(std::ranges::count(plan.steps, content, &scene::PaintStep::content));
}

/// Steps that use depth so.
int count(const scene::FramePlan& plan, DepthUse depth) {
    return static_cast<int>(std::ranges::count(plan.steps, depth, &scene::PaintStep::depth));
}

} // namespace

TEST_CASE("an aircraft is a mesh near the eye and polygons far from it, and no depth is asked for "
          "there") {
    Flight flight;
    planning::Planner planner(flight.scene, flight.settings);
    const std::array near{state_at({30, 0, 50})};
    const planning::PlannedFrame solid = planner.plan({flight.camera, near});
    CHECK(count(solid.plan, DepthUse::Nearest) == 1);
    CHECK(count(solid.plan, Content::ClearDepth) == 1);
    CHECK(solid.counts.aircraft_level == 0);
    CHECK(solid.counts.aircraft_polygons == 4);
    const std::array far{state_at({190, 0, 50})};
    const planning::PlannedFrame painted = planner.plan({flight.camera, far});
    CHECK(count(painted.plan, DepthUse::Nearest) == 0);
    CHECK(painted.plan.depth_boxes.empty());
    CHECK(painted.counts.aircraft_level == 1);
    CHECK(painted.counts.aircraft_polygons == 6);
}

TEST_CASE("depth is cleared where the mesh is seen and nowhere else") {
    Flight flight;
    planning::Planner planner(flight.scene, flight.settings);
    const std::array near{state_at({30, 0, 50})};
    const scene::FramePlan& plan = planner.plan({flight.camera, near}).plan;
    REQUIRE(plan.depth_boxes.size() == 1);
    const scene::PixelBox& box = plan.depth_boxes[0];
    CHECK(box.min.x > 280);
    CHECK(box.max.x < 360);
    CHECK(box.min.x < 320);
    CHECK(box.max.x > 320);
    CHECK(box.min.y > 200);
    CHECK(box.max.y < 280);
}

TEST_CASE("an eye inside the box of a mesh gets depth in the whole picture") {
    Flight flight;
    planning::Planner planner(flight.scene, flight.settings);
    const std::array around{state_at({0.2, 0, 50})};
    const scene::FramePlan& plan = planner.plan({flight.camera, around}).plan;
    REQUIRE(plan.depth_boxes.size() == 1);
    CHECK(plan.depth_boxes[0].min == glm::ivec2(0));
    CHECK(plan.depth_boxes[0].max == flight.settings.view.size_px);
}

TEST_CASE("ground that a mesh sticks in hides it by depth, and meshes that meet share one depth") {
    Flight flight;
    flight.scene.aircraft = {0, 0};
    flight.camera = scene::camera_looking_at({0, 0, 10}, {30, 0, 0});
    planning::Planner planner(flight.scene, flight.settings);
    const std::array both{state_at({30, 0, 0.3}), state_at({31, 0, 0.3})};
    const planning::PlannedFrame frame = planner.plan({flight.camera, both});
    const scene::FramePlan& plan = frame.plan;
    CHECK(count(plan, Content::ClearDepth) == 1);
    CHECK(count(plan, DepthUse::DepthOnly) == 1);
    CHECK(count(plan, DepthUse::Nearest) == 1);
    CHECK(frame.counts.overlap_groups == 1);
    const auto clear = std::ranges::find(plan.steps, Content::ClearDepth, &scene::PaintStep::content);
    REQUIRE(plan.steps.end() - clear >= 3);
    CHECK(clear[1].depth == DepthUse::DepthOnly);
    CHECK(clear[1].content == Content::GroundRepaint);
    CHECK(clear[2].depth == DepthUse::Nearest);
    CHECK(clear[2].content == Content::Aircraft);
    CHECK(clear[2].count == 2);
}

TEST_CASE("a mesh out of view costs as little as its polygons") {
    Flight flight;
    planning::Planner planner(flight.scene, flight.settings);
    const std::array behind{state_at({-20, 0, 50})};
    CHECK(planner.plan({flight.camera, behind}).counts.aircraft_level == 1);
}
