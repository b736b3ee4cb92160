#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/precedence.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

using namespace octant::visuals::draworder;

namespace {

ScreenPolygon seen(const std::vector<glm::dvec3>& corners) {
    ScreenPolygon polygon{corners, corners[0], corners[0]};
    for (const glm::dvec3& corner : corners) {
        polygon.least = glm::min(polygon.least, corner);
        polygon.most = glm::max(polygon.most, corner);
    }
    return polygon;
}

using Order = std::vector<std::uint32_t>;

} // namespace

TEST_CASE("the farther depth range is painted first, even where the polygons lie apart") {
    const auto far_one = seen({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto occluder = seen({{5, 5, 1}, {6, 5, 1}, {5, 6, 1}});
    CHECK(paint_first(far_one, occluder) == PaintFirst::A);
    CHECK(paint_first(occluder, far_one) == PaintFirst::B);
}

TEST_CASE("with nested depth ranges polygons in separate boxes are free") {
    const auto flat = seen({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto slanted = seen({{2, 0, -1}, {3, 0, 1}, {2, 1, 1}});
    CHECK(paint_first(flat, slanted) == PaintFirst::Either);
    CHECK(paint_first(slanted, flat) == PaintFirst::Either);
}

TEST_CASE("with nested depth ranges the depth at the first crossing of edges decides") {
    // A bar along x at depth 0; another along y from depth -1 to 3, at 0.6 to 1.4 where they cross.
    const auto flat = seen({{-5, -1, 0}, {5, -1, 0}, {5, 1, 0}, {-5, 1, 0}});
    const auto rising = seen({{-1, -5, -1}, {1, -5, -1}, {1, 5, 3}, {-1, 5, 3}});
    CHECK(paint_first(flat, rising) == PaintFirst::A);
    CHECK(paint_first(rising, flat) == PaintFirst::B);
}

TEST_CASE("polygons whose boxes overlap but whose edges do not cross are free") {
    const auto lower_left = seen({{0, 0, 0}, {4, 0, 1}, {0, 4, 1}});
    const auto upper_right = seen({{4, 4, 0.5}, {1, 4, 0.5}, {4, 1, 0.5}});
    CHECK(paint_first(lower_left, upper_right) == PaintFirst::Either);
}

TEST_CASE("polygons that share an edge are free when nothing else crosses") {
    const auto left = seen({{0, 0, 0}, {0, 1, 0}, {-1, 0, -1}});
    const auto right = seen({{0, 0, 0}, {1, 0, -1}, {0, 1, 0}});
    CHECK(paint_first(left, right) == PaintFirst::Either);
}

TEST_CASE("screen depth grows towards the eye, and planes stay planes in perspective") {
    for (const ScreenProjection screen : {ScreenProjection::Parallel, ScreenProjection::Perspective}) {
        const ScreenView view({30, 30, 30}, screen, 10.0);
        CHECK(view.screen_from_body({1, 1, 1}).z > view.screen_from_body({0, 0, 0}).z);
        CHECK(view.screen_from_body({0, 0, 0}) == glm::dvec3(0.0));
        const glm::dvec3 a = view.screen_from_body({0, 0, 0});
        const glm::dvec3 b = view.screen_from_body({7, 0, 1});
        const glm::dvec3 c = view.screen_from_body({0, 7, 2});
        const glm::dvec3 in_plane = view.screen_from_body({3.5, 1.75, 1.0});
        CHECK(glm::dot(glm::cross(b - a, c - a), in_plane - a) == Approx(0.0).margin(1e-12));
    }
}

TEST_CASE("without precedences the order is that of the numbers") {
    const TopologicalOrder sequence = topological_order(3, {});
    CHECK(sequence.order == Order{0, 1, 2});
    CHECK(sequence.broken_cycles == 0);
}

TEST_CASE("precedences are kept and the lowest number goes first otherwise") {
    const std::vector<Precedence> pairs{{3, 0}, {2, 3}, {2, 3}};
    CHECK(topological_order(5, pairs).order == Order{1, 2, 3, 0, 4});
}

TEST_CASE("a cycle is broken at the polygon that waits for the fewest, and counted") {
    const std::vector<Precedence> ring{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}};
    const TopologicalOrder sequence = topological_order(4, ring);
    CHECK(sequence.broken_cycles == 1);
    CHECK(sequence.order == Order{1, 2, 3, 0});
}
