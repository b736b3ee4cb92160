#include "visuals/planning/bounding_box.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

using namespace octant;
using namespace octant::visuals::planning;

namespace {

/// A square of 2 m, 10 m ahead (y), seen from its front.
ViewPolygon square() { return {{{-1, 10, -1}}, {{1, 10, -1}}, {{1, 10, 1}}, {{-1, 10, 1}}}; }

long cut_edges(const ViewPolygon& polygon) {
    return std::ranges::count_if(polygon, [](const ViewVertex& corner) { return corner.cut; });
}

} // namespace

TEST_CASE("a plane cuts a polygon to its front and marks the one new edge") {
    ViewPolygon polygon = square();
    ViewPolygon scratch;
    clip_to_front(polygon, {{1, 0, 0}, 0.0}, 1e-9, scratch);
    REQUIRE(polygon.size() == 4);
    CHECK(std::ranges::all_of(polygon, [](const ViewVertex& c) { return c.at_m.x >= 0.0; }));
    CHECK(cut_edges(polygon) == 1);
    for (std::size_t i = 0; i < 4; ++i) {
        const bool on_cut = polygon[i].at_m.x == 0.0 && polygon[(i + 1) % 4].at_m.x == 0.0;
        CHECK(polygon[i].cut == on_cut);
    }
    clip_to_front(polygon, {{0, 0, 1}, 0.0}, 1e-9, scratch);
    CHECK(polygon.size() == 4);
    CHECK(cut_edges(polygon) == 2);
}

TEST_CASE("a polygon that only touches a plane is left whole in front of it and gone behind it") {
    ViewPolygon scratch;
    ViewPolygon in_front = square();
    clip_to_front(in_front, {{1, 0, 0}, 1.0 - 1e-12}, 1e-9, scratch);
    CHECK(in_front.size() == 4);
    CHECK(cut_edges(in_front) == 0);
    ViewPolygon behind = square();
    clip_to_front(behind, {{-1, 0, 0}, -1.0 + 1e-12}, 1e-9, scratch);
    CHECK(behind.empty());
}

TEST_CASE("the cone over a polygon holds it and nothing beside it") {
    std::vector<glm::dvec3> cone;
    cone_of(square(), 0.0, cone);
    REQUIRE(cone.size() == 4);
    ViewPolygon scratch;
    ViewPolygon half_hidden = {{{0, 5, -3}}, {{3, 5, -3}}, {{3, 5, 3}}, {{0, 5, 3}}};
    clip_to_cone(half_hidden, cone, scratch);
    REQUIRE(half_hidden.size() == 4);
    for (const ViewVertex& corner : half_hidden) {
        CHECK(corner.at_m.x <= 0.5 + 1e-12);
        CHECK(std::abs(corner.at_m.z) == Approx(0.5));
    }
    ViewPolygon beside = {{{2, 5, 0}}, {{3, 5, 0}}, {{3, 5, 1}}};
    clip_to_cone(beside, cone, scratch);
    CHECK(beside.empty());
}

TEST_CASE("a small square covers its area over its distance squared") {
    CHECK(solid_angle_sr(square()) == Approx(4.0 / 100.0).epsilon(0.03));
    CHECK(solid_angle_sr({}) == 0.0);
}
