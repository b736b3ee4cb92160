#include "visuals/terrain/fan_triangles.h"

#include <catch2/catch.hpp>

namespace octant::visuals::terrain {

TEST_CASE("the border leaves of a triangle what lies within the field") {
    const ClipVertex west{{0, 0}, 10.0F, 7};
    const ClipVertex east{{8, 0}, 50.0F, 8};
    const ClipVertex north{{8, 8}, 90.0F, 9};
    SECTION("all of it, some of it in four corners, or nothing") {
        CHECK(clip_to_border({west, east, north}, {8, 8}).triangles() == 1);
        CHECK(clip_to_border({west, east, north}, {5, 3}).triangles() == 2);
        CHECK(clip_to_border({east, {{16, 8}, 0.0F, 10}, north}, {8, 8}).triangles() == 0);
    }
    SECTION("edges are crossed at samples, at their height there") {
        const ClippedPolygon left = clip_to_border({west, east, north}, {6, 8});
        REQUIRE(left.count == 3);
        CHECK(left.corner[0].vertex == 7);
        CHECK(left.corner[1].at.column == 6);
        CHECK(left.corner[1].at.row == 0);
        CHECK(left.corner[1].height == 40.0F);
        CHECK(left.corner[2].at.column == 6);
        CHECK(left.corner[2].at.row == 6);
        CHECK(left.corner[2].height == 70.0F);
    }
}

TEST_CASE("a node's triangles are counted as the border leaves them") {
    struct Field {
        int columns() const { return 6; }

        int rows() const { return 9; }
    };

    // The node from (0, 0) to (8, 8) with the border at column 5, beyond its centre at (4, 4).
    const FanTriangles left = triangles_within_border(FanSamples(Field(), 8, 0, 0));
    CHECK(left.whole == std::array<int, 4>{2, 1, 2, 1});
    CHECK(left.a == std::array<int, 4>{1, 1, 2, 1});
    CHECK(left.b == std::array<int, 4>{2, 1, 1, 1});
}

} // namespace octant::visuals::terrain
