#include "models/simplify/paper_simplify.h"

#include <catch2/catch.hpp>

using namespace octant::models::simplify;

namespace {

Point6 at(double x, double y, double z) { return {x, y, z}; }

/// Right angle at (2, 1), legs 4 and 3, in the plane z = 5.
const Corners triangle{at(2, 1, 5), at(6, 1, 5), at(2, 4, 5)};

} // namespace

TEST_CASE("a point over the inside of a triangle is as far as its foot") {
    const Foot foot = foot_on(triangle, at(3, 2, 7));
    CHECK(foot.inside);
    CHECK(foot.distance2 == Approx(4.0));
}

TEST_CASE("a point beside an edge is as far as the edge") {
    const Foot below = foot_on(triangle, at(4, -1, 6));
    CHECK_FALSE(below.inside);
    CHECK(below.distance2 == Approx(4.0 + 1.0));
    // The long edge: 3 x + 4 y = 22, and (3, 4) / 5 its normal; 10 beyond it.
    const Foot beyond = foot_on(triangle, at(4 + 6, 2.5 + 8, 5));
    CHECK_FALSE(beyond.inside);
    CHECK(beyond.distance2 == Approx(100.0));
}

TEST_CASE("a point beyond a corner is as far as the corner") {
    const Foot foot = foot_on(triangle, at(1, 0, 5));
    CHECK_FALSE(foot.inside);
    CHECK(foot.distance2 == Approx(2.0));
}

TEST_CASE("beyond a corner the opposite edge does not count, though it lies between its planes") {
    // The long edge is 2.4 away from the corner (2, 1), the corner 1.41 from the point.
    CHECK(foot_on(triangle, at(1, 0, 5)).distance2 < 2.4 * 2.4);
}

TEST_CASE("corners and points of an edge count as outside, at distance 0") {
    for (const Point6& point : {at(2, 1, 5), at(6, 1, 5), at(2, 4, 5), at(4, 1, 5), at(4, 2.5, 5)}) {
        const Foot foot = foot_on(triangle, point);
        CHECK_FALSE(foot.inside);
        CHECK(foot.distance2 == 0.0);
    }
}

TEST_CASE("a triangle whose plane holds the origin is like any other") {
    const Corners through_origin{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0)};
    const Foot foot = foot_on(through_origin, at(0.25, 0.25, 2));
    CHECK(foot.inside);
    CHECK(foot.distance2 == Approx(4.0));
}

TEST_CASE("a collapsed triangle has no inside and is as far as what is left of it") {
    const Corners edge{at(0, 0, 0), at(2, 0, 0), at(2, 0, 0)};
    CHECK_FALSE(foot_on(edge, at(1, 3, 0)).inside);
    CHECK(foot_on(edge, at(1, 3, 0)).distance2 == Approx(9.0));
    const Corners line{at(0, 0, 0), at(1, 0, 0), at(3, 0, 0)};
    CHECK(foot_on(line, at(2, 0, 4)).distance2 == Approx(16.0));
    const Corners point{at(1, 1, 1), at(1, 1, 1), at(1, 1, 1)};
    CHECK_FALSE(foot_on(point, at(1, 1, 3)).inside);
    CHECK(foot_on(point, at(1, 1, 3)).distance2 == Approx(4.0));
}

TEST_CASE("colour counts like another direction") {
    Corners red = triangle;
    for (Point6& corner : red) { corner[3] = 1.0; }
    const Foot foot = foot_on(red, at(3, 2, 7));
    CHECK(foot.inside);
    CHECK(foot.distance2 == Approx(4.0 + 1.0));
}
