#include "models/polygons/inside_outline.h"

#include <catch2/catch.hpp>

#include <vector>

using octant::models::polygons::distance_to_sides;
using octant::models::polygons::is_inside;

TEST_CASE("A point is inside an outline by its corners, whichever way the outline is turned") {
    const std::vector<glm::dvec3> square{{0, 0, 0}, {0, 2, 0}, {0, 2, 2}, {0, 0, 2}};
    const std::vector<glm::dvec3> turned(square.rbegin(), square.rend());
    for (const auto& outline : {square, turned}) {
        CHECK(is_inside(outline, {3, 0, 0}, {0, 1, 1}));
        CHECK(is_inside(outline, {-1, 0, 0}, {0, 0.1, 1.9}));
        CHECK_FALSE(is_inside(outline, {1, 0, 0}, {0, 3, 1}));
        CHECK_FALSE(is_inside(outline, {1, 0, 0}, {0, 1, -1}));
        CHECK(distance_to_sides(outline, {0, 1, 0.25}) == Approx(0.25));
        CHECK(distance_to_sides(outline, {0, 5, 6}) == Approx(5.0));
    }
}

TEST_CASE("A side as short as rounding does not cut an outline, whichever way it points") {
    const glm::dvec3 up(0, 0, 1);
    const glm::dvec3 corner(1e6, 1e6, 0);
    const double ulp = 1.2e-10;
    for (const glm::dvec3 aside : {glm::dvec3(ulp, ulp, 0), glm::dvec3(-ulp, ulp, 0)}) {
        const std::vector<glm::dvec3> outline{corner, corner + glm::dvec3(1, 0, 0), corner + glm::dvec3(1, 1, 0),
            corner + glm::dvec3(1, 1, 0) + aside, corner + glm::dvec3(0, 1, 0)};
        CHECK(is_inside(outline, up, corner + glm::dvec3(0.1, 0.1, 0)));
        CHECK(is_inside(outline, up, corner + glm::dvec3(0.9, 0.1, 0)));
        CHECK(is_inside(outline, up, corner + glm::dvec3(0.1, 0.9, 0)));
        CHECK_FALSE(is_inside(outline, up, corner + glm::dvec3(1.1, 0.9, 0)));
        CHECK(distance_to_sides(outline, corner + glm::dvec3(0.9, 0.5, 0)) == Approx(0.1));
    }
}

TEST_CASE("A dented outline has nothing in its dent") {
    const std::vector<glm::dvec3> arrow{{0, 0, 0}, {4, 2, 0}, {0, 4, 0}, {1, 2, 0}};
    CHECK(is_inside(arrow, {0, 0, 1}, {2, 2, 0}));
    CHECK_FALSE(is_inside(arrow, {0, 0, 1}, {0.5, 2, 0}));
}
