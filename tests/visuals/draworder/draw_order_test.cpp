#include "models/procedural/procedural_models.h"
#include "tests/paper_example.h"
#include "visuals/draworder/draw_order.h"

#include <catch2/catch.hpp>

using namespace octant::visuals::draworder;

namespace {

std::vector<std::uint32_t> list_of(const DrawOrder& order, int cell) {
    const auto span = order.polygons_of(cell);
    return {span.begin(), span.end()};
}

} // namespace

TEST_CASE("a draw order gives each octant its list, and equal lists are stored once") {
    OctantOrders orders;
    orders.lists[0] = {2, 0, 1};
    orders.lists[5] = {1};
    orders.lists[6] = {2, 0, 1};
    const DrawOrder order(orders);
    CHECK(order.cell_count() == 8);
    for (int cell = 0; cell < 8; ++cell) {
        CHECK(list_of(order, cell) == orders.lists[static_cast<std::size_t>(cell)]);
    }
    CHECK(order.polygons().size() == 4);
    CHECK(order.range_of(0) == order.range_of(6));
    CHECK(order.range_of(5) == DrawOrder::Range{3, 1});
    CHECK(order.cell_of({-1, 1, -1}) == 5);
}

TEST_CASE("one list serves every eye when there is one cell") {
    const DrawOrder order(std::vector<std::uint32_t>{3, 1});
    CHECK(order.cell_count() == 1);
    CHECK(order.cell_of({-1, -1, -1}) == 0);
    CHECK(list_of(order, 0) == std::vector<std::uint32_t>{3, 1});
}

TEST_CASE("file order lists every polygon once") {
    const auto model = octant::models::procedural::background60();
    const DrawOrder order = file_order(model);
    REQUIRE(order.polygons().size() == 60);
    for (std::uint32_t i = 0; i < 60; ++i) { CHECK(order.polygons()[i] == i); }
}

TEST_CASE("the example's eight lists are eight different ones") {
    const DrawOrder order(paper_orders(octant::tests::paper_example()));
    CHECK(order.polygons().size() == 6 + 6 + 5 * 4 + 4 + 4);
}

TEST_CASE("an eye paints the far side of a parting, what faces it there, then its own side") {
    using Kind = DrawOrder::Kind;
    constexpr int no_child = DrawOrder::no_child;
    const std::vector<std::vector<std::uint32_t>> lists{{0}, {1}, {2}, {3, 4}, {5}};
    const DrawOrder order(
        {{{{0, 0, 1}, 0}, 1, ~0, Kind::PolygonSplit, ~2, ~1}, {{}, ~3, 2, Kind::Sequence, no_child, no_child},
            {{{1, 0, 0}, 0}, ~4, no_child, Kind::ViewSplit, no_child, no_child}},
        lists);
    CHECK_FALSE(order.has_one_cell_per_eye());
    DrawOrder::Walk walk;
    const auto painted = [&](const glm::dvec3& eye) {
        std::vector<std::uint32_t> list;
        order.append_painted(eye, walk, list);
        return list;
    };
    CHECK(painted({1, 0, 1}) == std::vector<std::uint32_t>{0, 2, 3, 4, 5});
    CHECK(painted({-1, 0, 1}) == std::vector<std::uint32_t>{0, 2, 3, 4});
    CHECK(painted({1, 0, -1}) == std::vector<std::uint32_t>{3, 4, 5, 1, 0});
    CHECK(order.ranges_of({1, 0, 1}, walk).size() == 2); // 2 to 5 lie side by side
}

TEST_CASE("where all nodes are choices each eye has one range, that of its cell") {
    const DrawOrder order(paper_orders(octant::tests::paper_example()));
    CHECK(order.has_one_cell_per_eye());
    DrawOrder::Walk walk;
    for (int cell = 0; cell < 8; ++cell) {
        const auto ranges = order.ranges_of(octant_signs(cell), walk);
        REQUIRE(ranges.size() == 1);
        CHECK(ranges.front() == order.range_of(cell));
    }
}
