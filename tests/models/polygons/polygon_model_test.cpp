#include "models/polygons/polygon_model.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>

using namespace octant::models;
using namespace octant::models::polygons;

namespace {

/// A model of one polygon.
PolygonModel polygon(const std::vector<glm::dvec3>& corners_m) {
    PolygonModel model;
    model.vertices_m = corners_m;
    for (std::uint32_t i = 0; i < corners_m.size(); ++i) { model.corner_vertices.push_back(i); }
    model.polygons.push_back({.corner_count = static_cast<std::uint32_t>(corners_m.size())});
    model.materials.emplace_back();
    model.parts.emplace_back("default");
    return model;
}

std::string fault(const std::vector<glm::dvec3>& corners_m, double tolerance_m = 1e-4) {
    return polygon_fault(polygon(corners_m), 0, tolerance_m).value_or("none");
}

} // namespace

TEST_CASE("the normal points to the side from which the corners run counter-clockwise") {
    CHECK(normal_of(polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}), 0) == glm::dvec3(0, 0, 1));
    CHECK(normal_of(polygon({{0, 2, 0}, {2, 2, 0}, {2, 0, 0}, {0, 0, 0}}), 0) == glm::dvec3(0, 0, -1));
}

TEST_CASE("the normal does not depend on three corners in a row on one line") {
    CHECK(normal_of(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}}), 0) == glm::dvec3(0, 0, 1));
}

TEST_CASE("the normal of a small polygon keeps its digits far from the origin") {
    const glm::dvec3 n = normal_of(polygon({{1e6, 1e6, 5}, {1e6 + 0.01, 1e6, 5}, {1e6, 1e6 + 0.01, 5}}), 0);
    CHECK(n.z == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("the radius is that of the farthest vertex") {
    CHECK(radius_m(polygon({{0, 0, 0}, {3, 4, 0}, {0, -2, 0}})) == 5.0);
}

TEST_CASE("the tolerance is 1e-4 of the size, whichever way a model is turned") {
    const double half_box = std::sqrt(3.0);
    std::vector<glm::dvec3> corners_m;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) { corners_m.emplace_back(x, y, z); }
        }
    }
    CHECK(flatness_tolerance_m(polygon(corners_m)) == Approx(2e-4 * half_box));
    const glm::dquat turn = glm::angleAxis(1.0, glm::normalize(glm::dvec3(1, -2, 0.5)));
    for (glm::dvec3& corner_m : corners_m) { corner_m = turn * corner_m + glm::dvec3(1e6, 0, -1e6); }
    CHECK(flatness_tolerance_m(polygon(corners_m)) == Approx(2e-4 * half_box).epsilon(1e-9));
}

TEST_CASE("convex planar polygons have no fault") {
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == "none");
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}}) == "none");
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}}) == "none"); // a corner on a side
}

TEST_CASE("each fault of a polygon is named") {
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}}) ==
          "expected corners in different places, got corners 2 and 4 in one");
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}) == "expected a polygon with an area, got corners on one line");
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}) ==
          "expected a planar polygon (within 0.0001 m), got corner 1 0.0249 m off the plane");
    CHECK(fault({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}) ==
          "expected a convex polygon, got corner 4 2.53 m outside the edge from corner 2 to 3");
}

TEST_CASE("a star that turns left at every corner is not convex") {
    const auto star =
        fault({{0, 1, 0}, {-0.588, -0.809, 0}, {0.951, 0.309, 0}, {-0.951, 0.309, 0}, {0.588, -0.809, 0}});
    CHECK(star.find("expected a convex polygon") == 0);
}

TEST_CASE("bends and dents within the tolerance are accepted, beyond it refused") {
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.003}, {0, 1, 0}}, 1e-3) == "none");
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.005}, {0, 1, 0}}, 1e-3) != "none");
    CHECK(fault({{0, 0, 0}, {1, 0.0005, 0}, {2, 0, 0}, {1, 2, 0}}, 1e-3) == "none");
    CHECK(fault({{0, 0, 0}, {1, 0.005, 0}, {2, 0, 0}, {1, 2, 0}}, 1e-3) != "none");
}
