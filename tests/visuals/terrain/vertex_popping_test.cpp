#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/vertex_popping.h"

#include <catch2/catch.hpp>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

PerspectiveView looking_north(const glm::dvec3& eye_m) {
    PerspectiveView view;
    view.eye_m = eye_m;
    view.near_m = 0.5;
    return view;
}

} // namespace

TEST_CASE("the first frame has no jump and the same mesh again jumps by nothing") {
    Ground ground(rough_field(65, 65, 4));
    MeshView view;
    view.eye_m = {0.0, -40.0, 12.0};
    PoppingMeter meter;
    const GroundMesh mesh = ground.mesher.mesh(view, {8.0, 2.0, FanKind::Partial});
    CHECK_FALSE(meter.next(mesh, looking_north(view.eye_m)));
    const auto jump = meter.next(mesh, looking_north(view.eye_m));
    REQUIRE(jump);
    CHECK(jump->popping_px < 1e-3);
}

TEST_CASE("a vertex that comes in jumps by its height above the edge it halves") {
    Ground ground(bump_field(5, 2, 3, 2.0F)); // 2 m high, 1 m north of the middle
    MeshView view;
    view.eye_m = {0.0, -9.0, 1.0};
    const PerspectiveView picture = looking_north(view.eye_m);
    const GroundMesh fine = ground.mesher.mesh(view, {1000.0, 20.0, FanKind::Partial});
    const std::vector<octant::models::ColourVertex> all(fine.vertices.begin(), fine.vertices.end());
    const std::vector<std::uint32_t> triangles(fine.indices.begin(), fine.indices.end());
    GroundMesh kept;
    kept.vertices = all;
    kept.indices = triangles;
    std::vector<octant::models::ColourVertex> level = all;
    for (auto& vertex : level) { vertex.position_m.z = -1.0F; }
    GroundMesh flat = kept;
    flat.vertices = level;
    for (const bool coming : {true, false}) {
        PoppingMeter meter;
        meter.next(coming ? flat : kept, picture);
        const auto jump = meter.next(coming ? kept : flat, picture);
        REQUIRE(jump);
        CHECK(jump->popping_px == Approx(869.1 * 2.0 / 10.0));
        CHECK(jump->place_m.y == Approx(1.0));
    }
}

TEST_CASE("what one of the two frames does not show is no jump") {
    Ground ground(bump_field(5, 2, 3, 2.0F));
    MeshView view;
    view.eye_m = {0.0, -9.0, 1.0};
    PerspectiveView away = looking_north(view.eye_m);
    away.ahead = {0.0, -1.0, 0.0};
    away.right = {-1.0, 0.0, 0.0};
    PoppingMeter meter;
    meter.next(ground.mesher.mesh(view, {1000.0, 20.0, FanKind::Partial}), away);
    const auto jump = meter.next(ground.mesher.mesh(view, {2.0, 0.0, FanKind::Partial}), looking_north(view.eye_m));
    REQUIRE(jump);
    CHECK(jump->popping_px == 0.0);
}
