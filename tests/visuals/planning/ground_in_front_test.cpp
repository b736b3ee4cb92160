#include "visuals/planning/ground_frame.h"

#include <catch2/catch.hpp>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::landscape;
using namespace octant::visuals::overlay;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

namespace {

/// The eye at the origin, 10 m above level ground; a box of 12 x 8 x 2 m 100 m north of it.
const OrientedBox wings{{0, 100, 0}, glm::dmat3(1.0), {6, 4, 1}};

/// Ground across the line of sight, level or rising to the north.
GroundTriangle strip(double x_m, double half_width_m, double from_y_m, double from_z_m, double to_y_m, double to_z_m) {
    return {glm::dvec3(x_m - half_width_m, from_y_m, from_z_m), glm::dvec3(x_m + half_width_m, from_y_m, from_z_m),
        glm::dvec3(x_m, to_y_m, to_z_m)};
}

struct Found {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> intersecting;
};

Found before(const OrientedBox& box, std::vector<GroundTriangle> triangles) {
    const auto mesher = triangle_ground(std::move(triangles))->mesher({});
    GroundCounts counts;
    const TriangleDraw draw = mesher->triangles({}, counts);
    GroundInFront in_front;
    in_front.find(box, *mesher, draw, glm::dvec3(0.0));
    Found found{{}, {in_front.intersecting().begin(), in_front.intersecting().end()}};
    for (const GroundInFrontTriangle& near : in_front.found()) { found.triangles.push_back(near.triangle); }
    return found;
}

using Numbers = std::vector<std::uint32_t>;

} // namespace

TEST_CASE("a ridge before the box is found, one behind it or lower than the sight lines is not") {
    CHECK(before(wings, {strip(0, 30, 50, -10, 60, 5)}).triangles == Numbers{0});
    CHECK(before(wings, {strip(0, 30, 120, -10, 130, 5)}).triangles.empty());
    CHECK(before(wings, {strip(0, 30, 50, -10, 60, -3)}).triangles.empty());
}

TEST_CASE("a ridge beside the box and ground that faces away are not before it") {
    CHECK(before(wings, {strip(60, 30, 50, -10, 60, 5)}).triangles.empty());
    GroundTriangle back = strip(0, 30, 50, -10, 60, 5);
    std::swap(back[0], back[1]);
    CHECK(before(wings, {back}).triangles.empty());
}

TEST_CASE("level ground under a box is not before it, however far it reaches towards the eye") {
    CHECK(before(wings, {strip(0, 200, 10, -10, 400, -10)}).triangles.empty());
}

TEST_CASE("rising ground that crosses the height of the box is before it where it is nearer") {
    // One plane runs through between box and eye, the other comes up behind the box.
    CHECK(before(wings, {strip(0, 40, 60, -10, 95, 30)}).triangles == Numbers{0});
    CHECK(before(wings, {strip(0, 40, 80, -10, 150, 10)}).triangles.empty());
}

TEST_CASE("ground that cuts the box is told apart and comes with what lies before") {
    const Found found =
        before(wings, {strip(0, 30, 120, -10, 130, 5), strip(0, 50, 90, -5, 110, 5), strip(0, 30, 50, -10, 60, 5)});
    CHECK(found.intersecting == Numbers{1});
    CHECK(found.triangles == Numbers{1, 2});
}

TEST_CASE("a triangle under one wing with a ridge before the other leaves the ridge alone") {
    // No order of the three whole things is right: the large triangle hides the ridge's foot, the ridge hides the box,
    // the box hides the large triangle.
    const GroundTriangle large = {glm::dvec3(-300, 20, -2.5), glm::dvec3(2, 20, -2.5), glm::dvec3(-150, 300, -2.5)};
    const GroundTriangle ridge = strip(5, 4, 60, -4, 70, 3);
    CHECK(before(wings, {ridge, large}).triangles == Numbers{0});
}

TEST_CASE("an eye inside the box has nothing before it") {
    const OrientedBox around{{0, 0, 0}, glm::dmat3(1.0), {6, 4, 1}};
    CHECK(before(around, {strip(0, 30, 50, -10, 60, 5)}).triangles.empty());
}

TEST_CASE("the volume of the sight lines leaves out what lies under them") {
    const ConvexVolume volume = sight_volume_of(wings);
    CHECK(may_intersect(volume, {-1, 40, -1}, {1, 60, 1}));
    CHECK_FALSE(may_intersect(volume, {-5000, -5000, -50}, {5000, 5000, -2}));
    CHECK_FALSE(may_intersect(volume, {-5000, 20, -50}, {5000, 60, -1.0}));
    CHECK_FALSE(may_intersect(volume, {-5000, 120, -50}, {5000, 500, 50}));
    CHECK_FALSE(may_intersect(volume, {20, 20, -50}, {40, 80, 50}));
}
