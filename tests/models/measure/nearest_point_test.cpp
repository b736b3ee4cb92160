#include "models/measure/triangle_bvh.h"
#include "tests/models/measure/made_meshes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace octant;
using models::measure::nearest_on_triangle;
using models::measure::NearestOnTriangle;

namespace {

const glm::dvec3 a(0.0, 0.0, 0.0);
const glm::dvec3 b(4.0, 0.0, 0.0);
const glm::dvec3 c(0.0, 4.0, 0.0);

double distance(const glm::dvec3& point) { return std::sqrt(nearest_on_triangle(point, a, b, c).distance2); }

/// The least distance to many points of the triangle, its corners among them.
double by_grid(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, const glm::dvec3& s) {
    constexpr int steps = 200;
    double least = glm::distance(p, q);
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            const glm::dvec3 point = q + (r - q) * (i / double{steps}) + (s - q) * (j / double{steps});
            least = std::min(least, glm::distance(p, point));
        }
    }
    return least;
}

} // namespace

TEST_CASE("each part of a triangle is nearest to the points before it") {
    CHECK(distance({1.0, 1.0, 3.0}) == 3.0);                    // inside
    CHECK(distance({2.0, -3.0, 0.0}) == 3.0);                   // edge ab
    CHECK(distance({-3.0, 2.0, 4.0}) == 5.0);                   // edge ca
    CHECK(distance({4.0, 4.0, 0.0}) == Approx(std::sqrt(8.0))); // edge bc
    CHECK(distance({-3.0, -4.0, 0.0}) == 5.0);                  // corner a
    CHECK(distance({7.0, 0.0, 4.0}) == 5.0);                    // corner b
    CHECK(distance({0.0, 7.0, 4.0}) == 5.0);                    // corner c
    CHECK(distance({1.0, 2.0, 0.0}) == 0.0);                    // on it
}

TEST_CASE("weights give the nearest point back") {
    tests::Dice dice(3);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = dice.point(-6.0, 6.0);
        const NearestOnTriangle found = nearest_on_triangle(p, a, b, c);
        const glm::dvec3& w = found.weights;
        CHECK((w.x >= 0.0 && w.y >= 0.0 && w.z >= 0.0));
        CHECK(w.x + w.y + w.z == Approx(1.0));
        CHECK(glm::distance(found.point, w.x * a + w.y * b + w.z * c) < 1e-14);
        CHECK(found.distance2 == Approx(glm::dot(found.point - p, found.point - p)));
    }
}

TEST_CASE("a triangle in a plane through the origin is as good as any other") {
    // Equation (6) of the paper is singular here.
    const NearestOnTriangle found =
        nearest_on_triangle({1.0, 1.0, 2.0}, {-3.0, -3.0, 0.0}, {5.0, -3.0, 0.0}, {1.0, 9.0, 0.0});
    CHECK(found.distance2 == Approx(4.0));
}

TEST_CASE("a triangle without area is its longest edge, one without length its corner") {
    const glm::dvec3 middle(1.0, 0.0, 0.0);
    const glm::dvec3 p(1.0, 3.0, 0.0);
    CHECK(nearest_on_triangle(p, a, b, middle).distance2 == 9.0);
    CHECK(nearest_on_triangle(p, middle, a, b).distance2 == 9.0);
    CHECK(nearest_on_triangle(p, a, a, b).distance2 == 9.0);
    CHECK(nearest_on_triangle(p, b, a, b).distance2 == 9.0);
    CHECK(nearest_on_triangle(p, a, a, a).distance2 == 10.0);
}

TEST_CASE("no point of a triangle is nearer than the nearest one") {
    tests::Dice dice(5);
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 p = dice.point(-1.0, 1.0);
        const glm::dvec3 q = dice.point(-1.0, 1.0);
        const glm::dvec3 r = dice.point(-1.0, 1.0);
        const glm::dvec3 s = dice.point(-1.0, 1.0);
        const double found = std::sqrt(nearest_on_triangle(p, q, r, s).distance2);
        const double tried = by_grid(p, q, r, s);
        CHECK(found <= tried + 1e-14);
        CHECK(found >= tried - 0.02);
    }
}

TEST_CASE("the distance to a needle keeps its accuracy, however thin it is") {
    // Far from the origin and askew, the point straight above the needle's inside.
    const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
    const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 up = glm::cross(along, across);
    const glm::dvec3 start(3.0, -2.0, 1.0);
    for (double width = 1e-1; width > 1e-18; width *= 0.1) {
        for (const double height : {0.0, 1e-9, 1e-3, 1.0}) {
            const glm::dvec3 apex = start + along * 0.4 + across * width;
            const glm::dvec3 p = start + along * 0.45 + across * (0.3 * width) + up * height;
            const double found = std::sqrt(nearest_on_triangle(p, start, start + along, apex).distance2);
            INFO("width " << width << ", height " << height);
            CHECK(std::abs(found - height) < 1e-14);
        }
    }
}
