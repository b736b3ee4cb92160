#include "models/simplify/paper_simplify.h"

#include <catch2/catch.hpp>

using namespace octant::models::simplify;

namespace {

Corners level_triangle(double z) { return {Point6{0, 0, z}, Point6{3, 0, z}, Point6{0, 2, z}}; }

} // namespace

TEST_CASE("a quadric gives the squared distance to its plane, inside the triangle or not") {
    const PlaneQuadric quadric = PlaneQuadric::of_plane(level_triangle(1.0));
    CHECK(quadric.at(Point6{1, 0.5, 3}) == Approx(4.0));
    CHECK(quadric.at(Point6{50, -70, 3}) == Approx(4.0));
    CHECK(quadric.at(Point6{8, 8, 1}) == Approx(0.0).margin(1e-12));
}

TEST_CASE("added quadrics give the sum of the distances") {
    PlaneQuadric sum = PlaneQuadric::of_plane(level_triangle(0.0));
    sum.add(PlaneQuadric::of_plane(level_triangle(1.0)));
    CHECK(sum.at(Point6{7, 7, 3}) == Approx(9.0 + 4.0));
}

TEST_CASE("a triangle without area has no plane") {
    const Corners line{Point6{0, 0, 0}, Point6{1, 0, 0}, Point6{2, 0, 0}};
    CHECK(PlaneQuadric::of_plane(line).at(Point6{5, 5, 5}) == 0.0);
    CHECK(PlaneQuadric::of_coloured_plane(line).at(Point6{5, 5, 5}) == 0.0);
}

TEST_CASE("over a triangle of one colour a coloured quadric adds the distance in colour") {
    const PlaneQuadric quadric = PlaneQuadric::of_coloured_plane(level_triangle(1.0));
    CHECK(quadric.at(Point6{9, 9, 3, 0.5, 0, 0}) == Approx(4.0 + 0.25));
}

TEST_CASE("a coloured quadric follows the slope of the colour") {
    Corners sloping = level_triangle(0.0);
    sloping[1][3] = 3.0;
    const PlaneQuadric quadric = PlaneQuadric::of_coloured_plane(sloping);
    CHECK(quadric.at(Point6{2, 0, 0, 2, 0, 0}) == Approx(0.0).margin(1e-12));
    // Off the slope by 1 in the plane of x and red, which rises at 45 degrees: half of it squared.
    CHECK(quadric.at(Point6{2, 0, 0, 1, 0, 0}) == Approx(0.5));
}
