#include "visuals/planning/bounding_box.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::planning;

namespace {

OrientedBox box_at(const glm::dvec3& centre_m, const glm::dvec3& half_m) { return {centre_m, glm::dmat3(1.0), half_m}; }

} // namespace

TEST_CASE("the outline of a box has four edges face-on and six from a corner") {
    CHECK(cone_of(box_at({0, 10, 0}, {1, 1, 1})).count == 4);
    CHECK(cone_of(box_at({5, 10, 0}, {1, 1, 1})).count == 6);
    CHECK(cone_of(box_at({5, 10, -7}, {1, 1, 1})).count == 6);
}

TEST_CASE("a box and no other direction lies inside its cone") {
    PlaceDice dice(7);
    for (int i = 0; i < 200; ++i) {
        const OrientedBox box{dice.in_box(glm::dvec3(30)), glm::mat3_cast(dice.attitude()), {5.0, 3.0, 1.0}};
        if (contains_eye(box)) { continue; }
        const ViewCone cone = cone_of(box);
        const auto corners = corners_of(box);
        for (const glm::dvec3& normal : cone.planes()) {
            int on_plane = 0;
            for (const glm::dvec3& corner : corners) {
                CHECK(glm::dot(normal, corner) > -1e-9);
                on_plane += std::abs(glm::dot(normal, corner)) < 1e-9 ? 1 : 0;
            }
            CHECK(on_plane >= 2);
        }
    }
}

TEST_CASE("a sight line enters a box at its near side") {
    const OrientedBox box = box_at({0, 10, 0}, {1, 2, 1});
    CHECK(entry_distance(box, {0, 1, 0}) == Approx(8.0));
    CHECK(entry_distance(box, {0.1, 4, 0}) == Approx(2.0));
}

TEST_CASE("of two boxes one behind the other only the near one hides") {
    const OcclusionPair pair = occlusion_pair(box_at({0, 10, 0}, {3, 1, 1}), box_at({2, 14, 0}, {3, 1, 1}));
    CHECK_FALSE(pair.intersect);
    CHECK(pair.a_occludes_b);
    CHECK_FALSE(pair.b_occludes_a);
}

TEST_CASE("boxes seen side by side hide nothing of each other") {
    const OcclusionPair pair = occlusion_pair(box_at({-5, 10, 0}, {3, 1, 1}), box_at({5, 12, 0}, {3, 1, 1}));
    CHECK_FALSE(pair.intersect);
    CHECK_FALSE(pair.a_occludes_b);
    CHECK_FALSE(pair.b_occludes_a);
}

TEST_CASE("boxes that share points meet") {
    CHECK(occlusion_pair(box_at({0, 10, 0}, {3, 1, 1}), box_at({2, 11, 0}, {3, 1, 1})).intersect);
}

TEST_CASE("the hull holds the whole circle that a turning part runs") {
    models::polygons::PolygonModel model = box_model({4.0, 1.0, 1.0});
    model.parts.emplace_back("rotor");
    const auto first = static_cast<std::uint32_t>(model.vertices_m.size());
    model.vertices_m.insert(model.vertices_m.end(), {{1.0, 0.0, -2.0}, {6.0, -0.2, -2.0}, {6.0, 0.2, -2.0}});
    model.polygons.push_back({static_cast<std::uint32_t>(model.corner_vertices.size()), 3, 0, 1});
    model.corner_vertices.insert(model.corner_vertices.end(), {first, first + 1, first + 2});
    model.pivots.push_back({1, {1.0, 0.0, -2.0}, {0.0, 0.0, 1.0}, 5.0});
    const AxisAlignedBox extent = model_bounds(model);
    const double arm_m = std::hypot(5.0, 0.2);
    CHECK(extent.max_m.x == Approx(1.0 + arm_m));
    CHECK(extent.min_m.x == Approx(1.0 - arm_m));
    CHECK(extent.max_m.y == Approx(arm_m));
    CHECK(extent.min_m.z == Approx(-2.0));
    CHECK(extent.max_m.z == Approx(1.0));
}
