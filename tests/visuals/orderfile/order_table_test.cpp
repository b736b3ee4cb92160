#include "models/polygons/polygon_model.h"
#include "tests/paper_example.h"
#include "visuals/orderfile/order_table.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant;
using namespace octant::visuals::orderfile;
using visuals::draworder::ordered;
using visuals::draworder::OrderMethod;

namespace {

const auto plain_axes = models::polygons::FileAxes::from_text("forward,right,down"); // file = body

} // namespace

TEST_CASE("orders are shown in the form of the paper's table 4") {
    const auto model = tests::paper_example();
    const auto rows =
        order_table(model, cell_orders(ordered(model, {.method = OrderMethod::Paper, .paper = {}})), plain_axes);
    REQUIRE(rows.size() == 8);
    CHECK(rows[0].cell == "+++");
    CHECK(rows[1].cell == "++-");
    CHECK(rows[4].cell == "-++");
    CHECK(rows[0].region.empty());
    CHECK(rows[7].list == "P6, P10, P5, P9");
}

TEST_CASE("a region is told by polygons, axes and sums") {
    auto model = tests::paper_example();
    CHECK(region_description({}, model, plain_axes) == "everywhere");
    model.vertices_m[0].x = -120; // tips P1, P5 and others
    const Plane p5 = models::polygons::plane_of(model, 4);
    const std::vector<Plane> planes{
        {{0, 1, 0}, -2.5}, {{0, 0, -1}, 3}, p5, {-p5.normal, -p5.offset_m}, {glm::normalize(glm::dvec3(3, -4, 0)), -1}};
    CHECK(region_description(planes, model, plain_axes) ==
          "y > 2.5, z < 3, in front of P5, behind P5, 0.600 x - 0.800 y > 1");
    // right, up, back: the file's x is the body's y, its y is up.
    CHECK(region_description({planes.data(), 2}, model, {}) == "x > 2.5, y > -3");
}
