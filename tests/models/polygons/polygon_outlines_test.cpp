#include "models/polygons/polygon_outlines.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>
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

using octant::models::polygons::has_separating_edge;

namespace {

using Corners = std::vector<glm::dvec3>;

const glm::dvec3 up(0, 0, 1);
const Corners wide_square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};

Corners moved(Corners corners, double east) {
    for (glm::dvec3& corner : corners) { corner.x += east; }
    return corners;
}

} // namespace

TEST_CASE("an edge parts a square from one that touches it, and from none that overlaps it") {
    CHECK(has_separating_edge(wide_square, up, moved(wide_square, 2.0), 0.0));
    CHECK(has_separating_edge(wide_square, up, moved(wide_square, 3.0), 0.0));
    CHECK_FALSE(has_separating_edge(wide_square, up, moved(wide_square, 1.5), 0.0));
    CHECK(has_separating_edge(wide_square, up, moved(wide_square, 1.5), 0.5));
    CHECK_FALSE(has_separating_edge(wide_square, up, moved(wide_square, 1.4), 0.5));
}

TEST_CASE("where no edge of one outline parts them, one of the other may") {
    const Corners at_a_corner{{2.5, 1.5, 0}, {3, 3, 0}, {1.5, 2.5, 0}};
    CHECK_FALSE(has_separating_edge(wide_square, up, at_a_corner, 0.0));
    CHECK(has_separating_edge(at_a_corner, up, wide_square, 0.0));
}

using namespace octant::models::polygons;

namespace {

using Places = std::vector<std::array<std::size_t, 3>>;

/// Sum of the signed areas along z, and the smallest of them.
std::pair<double, double> areas(const std::vector<glm::dvec3>& corners, const Places& pieces) {
    double sum = 0.0;
    double least = 1e9;
    for (const auto& [a, b, c] : pieces) {
        const double area = 0.5 * glm::cross(corners[b] - corners[a], corners[c] - corners[a]).z;
        sum += area;
        least = std::min(least, area);
    }
    return {sum, least};
}

} // namespace

TEST_CASE("a convex polygon becomes a fan around its first corner") {
    const std::vector<glm::dvec3> square{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
    CHECK(triangulate_polygon(square) == Places{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("a dented polygon is cut inside its outline") {
    const std::vector<glm::dvec3> arrow{{0.0, 0.0, 0.0}, {2.0, -1.0, 0.0}, {0.5, 0.0, 0.0}, {2.0, 1.0, 0.0}};
    // The dent at corner 2 sees corner 0 only.
    const Places pieces = triangulate_polygon(arrow);
    REQUIRE(pieces.size() == 2);
    const auto [sum, least] = areas(arrow, pieces);
    CHECK(sum == Approx(0.5));
    CHECK(least == Approx(0.25));
}

TEST_CASE("corners on a straight side make no triangle without an area") {
    const std::vector<glm::dvec3> corners{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 1.0, 0.0},
        {2.0, 2.0, 0.0}, {1.0, 2.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 1.0, 0.0}};
    const auto [sum, least] = areas(corners, triangulate_polygon(corners));
    CHECK(sum == Approx(4.0));
    CHECK(least > 0.1);
}

TEST_CASE("a comb is cut without overlaps, also when it is seen from behind") {
    std::vector<glm::dvec3> comb{{8.0, -1.0, 0.0}};
    for (int tooth = 8; tooth >= 0; --tooth) { comb.emplace_back(tooth, tooth % 2 == 0 ? 3.0 : 0.0, 0.0); }
    comb.emplace_back(0.0, -1.0, 0.0);
    const auto [sum, least] = areas(comb, triangulate_polygon(comb));
    CHECK(sum == Approx(8.0 + 12.0));
    CHECK(least > 0.0);
    std::vector<glm::dvec3> behind(comb.rbegin(), comb.rend());
    const auto [sum_behind, min_behind] = areas(behind, triangulate_polygon(behind));
    CHECK(sum_behind == Approx(-20.0));
    CHECK(min_behind < 0.0);
}

TEST_CASE("what crosses itself or has no area still gives two triangles fewer than corners") {
    const std::vector<glm::dvec3> bow{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    CHECK(triangulate_polygon(bow).size() == 2);
    CHECK(triangulate_polygon(std::vector<glm::dvec3>(7, glm::dvec3(3.0))).size() == 5);
}
