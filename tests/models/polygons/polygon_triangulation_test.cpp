#include "models/polygons/polygon_triangulation.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

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
