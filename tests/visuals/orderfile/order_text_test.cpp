#include "models/polygons/polygon_model.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/random_generator.h"
#include "tests/paper_example.h"
#include "tests/scratch.h"
#include "visuals/orderfile/order_text.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

using namespace octant;
using namespace octant::visuals::orderfile;
using visuals::draworder::DrawOrder;
using visuals::draworder::ordered;
using visuals::draworder::OrderMethod;

namespace {

const auto plain_axes = models::polygons::FileAxes::from_text("forward,right,down"); // file = body

std::filesystem::path file_with(const std::string& text) {
    const auto path = tests::scratch_folder() / "orders.txt";
    write_file(path, text);
    return path;
}

CellOrders read(const std::string& text, std::size_t faces = 3) {
    return read_order_file(file_with(text), faces, plain_axes);
}

std::string refusal(const std::string& text) {
    try {
        read(text);
    } catch (const Error& fault) {
        const std::string line = fault.what();
        return line.substr(line.find("orders.txt") + 10);
    }
    return "accepted";
}

const std::string head = "draworder 1\nfaces 3\n";

} // namespace

TEST_CASE("orders come back from their text as they were, byte for byte") {
    const std::string text = "draworder 1\ncenter 0.10000000000000001 0 -3\nmetric l1\nfaces 3\n"
                             "twosided 1\nparents 0 0 4\n"
                             "cell +-+/0/3 min 2 order 2 0 1\n"
                             "cell cone 3 1 0 0 0 1 0 0 0 -1 max 7.5 order 1\n"
                             "cell half 2 0 0 1 -0.33333333333333331 0 1 0 0 order\n"
                             "cell half 0 order 0 1 2\n";
    for (const char* axes : {"right,up,back", "forward,right,down", "up,right,forward"}) {
        const auto file_axes = models::polygons::FileAxes::from_text(axes);
        const CellOrders orders = read_order_file(file_with(text), 3, file_axes);
        CHECK(order_text(orders, file_axes) == text);
    }
}

TEST_CASE("a file is read into cells, planes, distances and lists") {
    const CellOrders orders = read("# orders by hand\n\ndraworder 1 # version\nfaces 3\r\ncenter 1 0 0\n"
                                   "cell half 1 0 0 2 -4 order 2\ncell +++ min 5 max 9 order 0 1\ncell ++- order 1\n");
    REQUIRE(orders.cells.size() == 3);
    CHECK(orders.metric == Metric::L2);
    CHECK(orders.cells[0].planes == std::vector<Plane>{{{0, 0, 1}, -2}});
    CHECK(orders.cells[1].list == std::vector<std::uint32_t>{0, 1});
    CHECK(cell_of(orders, {1, 0, 3}) == 0); // above 2, though octant +++ has it, too
    CHECK(cell_of(orders, {7, 0, 1}) == 1); // 6.1 from the centre
    CHECK(cell_of(orders, {3, 1, 1}) == std::nullopt);
    CHECK(cell_of(orders, {11, 3, 1}) == std::nullopt);
    CHECK(cell_of(orders, {2, 1, -1}) == 2);
    CHECK(cell_of(orders, {0.5, 1, -1}) == std::nullopt); // left of the centre
}

TEST_CASE("the octant orders of a model and its exported file choose the same lists") {
    const auto ordered_example = ordered(tests::paper_example(), {.method = OrderMethod::Paper});
    const models::polygons::FileAxes axes;
    const auto path = file_with(order_text(cell_orders(ordered_example), axes));
    const CellOrders orders = read_order_file(path, 10, axes);
    RandomGenerator dice(3);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 eye_m = dice.direction() * 1000.0;
        const auto cell = cell_of(orders, eye_m);
        REQUIRE(cell);
        const auto expected = ordered_example.order.polygons_of(ordered_example.order.cell_of(eye_m));
        CHECK(std::ranges::equal(orders.cells[*cell].list, expected));
    }
    CHECK(cell_of(orders, {10, 10, 10}) == std::nullopt);
}

TEST_CASE("parts come back from their text as they were, and paint the same") {
    const std::string text = "draworder 1\nmetric l2\nfaces 5\n"
                             "list 0 1\nlist\nlist 2\nlist 3 4\n"
                             "node parting 0 0 1 -0.5 node 1 list 0 list 2 nothing\n"
                             "node sequence list 1 node 2\n"
                             "node choice 1 0 0 0 list 3 nothing\n";
    const CellOrders orders = read(text, 5);
    REQUIRE(orders.parts);
    CHECK(orders.cells.empty());
    CHECK(order_text(orders, plain_axes) == text);
    DrawOrder::Walk walk;
    std::vector<std::uint32_t> painted;
    orders.parts->append_painted({1, 0, 1}, walk, painted);
    CHECK(painted == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
}

TEST_CASE("parts that hang together badly are refused") {
    const std::string lists = head + "list 0\nlist 1 2\n";
    CHECK(refusal(lists) == ": expected nodes between several lists, got none");
    CHECK(refusal(lists + "node sequence list 0 list 2\n") ==
          ": expected children among 1 nodes and 2 lists, got list 2");
    CHECK_THAT(
        refusal(lists + "node sequence list 0 node 0\n"), Catch::StartsWith(":5: expected the number of a later node"));
    CHECK_THAT(refusal(lists + "node sequence node 1 node 1\nnode sequence list 0 list 1\n"),
        Catch::StartsWith(":5: expected each node below one other, got '1'"));
    CHECK_THAT(refusal(lists + "node either list 0 list 1\n"),
        Catch::StartsWith(":5: expected choice, parting or sequence, got 'either'"));
    CHECK_THAT(refusal(lists + "cell half 0 order 0\n"), Catch::StartsWith(":5: expected either cells or parts"));
}

TEST_CASE("whatever is wrong with a file of orders is told with its line") {
    using Catch::StartsWith;
    CHECK_THAT(refusal(""), StartsWith(": expected 'draworder 1' first"));
    CHECK_THAT(refusal("draworder 2\n"), StartsWith(":1: expected 'draworder 1' first"));
    CHECK_THAT(refusal("faces 3\n"), StartsWith(":1: expected 'draworder 1' first"));
    CHECK(refusal(head) == ": expected at least one cell or list, got none");
    CHECK(refusal("draworder 1\nfaces 4\n") == ":2: expected as many faces as the model has (3 to 3), got '4'");
    CHECK_THAT(refusal("draworder 1\ncell +++ order 0\n"), StartsWith(":2: expected faces before"));
    CHECK_THAT(refusal(head + "faces 3\n"), StartsWith(":3: expected each keyword once"));
    CHECK_THAT(refusal(head + "cell +++ order 0\nmetric l1\n"), StartsWith(":4: expected each"));
    CHECK_THAT(refusal(head + "sphere 1\n"), StartsWith(":3: expected center, metric"));
    CHECK_THAT(refusal(head + "metric l3\n"), StartsWith(":3: expected l1 or l2, got 'l3'"));
    CHECK_THAT(refusal(head + "center 0 nan 0\n"), StartsWith(":3: expected the centre"));
    CHECK_THAT(refusal(head + "center 0 0\n"), StartsWith(":3: expected the centre"));
    CHECK_THAT(refusal(head + "center 0 0 0 0\n"), StartsWith(":3: expected the end of the line"));
    CHECK_THAT(refusal(head + "parents 0 1\n"), StartsWith(":3: expected a polygon of the whole"));
    CHECK_THAT(refusal(head + "cell ++ order 0\n"), StartsWith(":3: expected a region"));
    CHECK_THAT(refusal(head + "cell +++/4 order 0\n"), StartsWith(":3: expected a region"));
    CHECK_THAT(refusal(head + "cell ball 3 order 0\n"), StartsWith(":3: expected a region"));
    CHECK_THAT(
        refusal(head + "cell +++ order 0 3\n"), StartsWith(":3: expected a polygon of the model (0 to 2), got '3'"));
    CHECK_THAT(refusal(head + "cell +++ order 0 x\n"), StartsWith(":3: expected a polygon"));
    CHECK(refusal(head + "cell +++ order 0 1 0\n") == ":3: expected each polygon once, got '0'");
    CHECK_THAT(refusal(head + "cell +++ 0 1\n"), StartsWith(":3: expected min R, max R or order"));
    CHECK_THAT(refusal(head + "cell +++ min -1 order 0\n"), StartsWith(":3: expected the least"));
    CHECK_THAT(refusal(head + "cell +++ min 2 max 2 order 0\n"),
        StartsWith(":3: expected a greatest distance above the least, got '2'"));
    CHECK_THAT(refusal(head + "cell half 1 0 0 1 inf order 0\n"), StartsWith(":3: expected an off"));
    CHECK_THAT(refusal(head + "cell half 1 0 0 0 1 order\n"), StartsWith(":3: expected a normal w"));
    CHECK_THAT(refusal(head + "cell half -1 order 0\n"), StartsWith(":3: expected how many"));
    CHECK_THAT(refusal(head + "cell cone 3 1 0 0 0 1 0 1 1 0 order 0\n"),
        StartsWith(":3: expected directions that do not lie in one plane"));
    CHECK_THAT(refusal(head + "cell cone 2 1 0 0 0 1 0 order 0\n"), StartsWith(":3: expected how"));
    CHECK_THROWS_WITH(read(std::string("draworder 1\0", 12)), Catch::Contains("expected text, got binary"));
}

TEST_CASE("orders are shown in the form of the paper's table 4") {
    const auto model = tests::paper_example();
    const auto rows = order_table(model, cell_orders(ordered(model, {.method = OrderMethod::Paper})), plain_axes);
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
