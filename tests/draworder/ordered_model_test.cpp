#include "visuals/draworder/ordered_model.h"

#include <catch2/catch.hpp>

#include "wrong_rays.h"

using namespace octant::visuals::draworder;
using octant::tests::paper_example;

TEST_CASE("the paper's method names its eight octants and keeps its lists") {
    const OctantOrders orders = paper_orders(paper_example());
    const OrderedModel model = ordered(paper_example(), {.method = Method::Paper, .paper = {}});
    REQUIRE(model.cells.size() == 8);
    for (int octant = 0; octant < 8; ++octant) {
        const OrderCell& cell = model.cells[static_cast<std::size_t>(octant)];
        CHECK(cell.path == octant_name(octant));
        const auto list = model.order.polygons_of(octant);
        const auto& expected = orders.lists[static_cast<std::size_t>(octant)];
        CHECK(std::vector<std::uint32_t>(list.begin(), list.end()) == expected);
        for (const octant::Plane& plane : cell.planes) {
            CHECK(octant::distance_m(plane, octant_signs(octant)) == 1.0);
        }
    }
    CHECK(model.splits == 0);
    CHECK(model.cyclic_cells == 0);
}
