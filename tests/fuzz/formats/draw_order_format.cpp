#include "sim/base/output_file.h"
#include "tests/fuzz/formats/small_model.h"
#include "tests/fuzz/formats/target.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/order_text.h"

namespace octant::tests::formats::draw_order_format {

namespace {

namespace draworder = visuals::draworder;
namespace orderfile = visuals::orderfile;

constexpr std::size_t faces = 7;

/// Tells the cells or the painted polygons of some eyes, and writes and reads the orders again.
void use(const std::filesystem::path& file) {
    const orderfile::CellOrders orders = orderfile::read_order_file(file, faces);
    for (const glm::dvec3& eye_m : some_eyes()) {
        const auto cell = orderfile::cell_of(orders, eye_m);
        expect(!cell || *cell < orders.cells.size(), "a cell that is there");
        if (orders.parts) {
            draworder::DrawOrder::Walk walk;
            std::vector<std::uint32_t> painted;
            orders.parts->append_painted(eye_m, walk, painted);
            for (const std::uint32_t polygon : painted) { expect(polygon < faces, "polygons that are there"); }
        }
    }
    const std::filesystem::path written = file.parent_path() / "again.order";
    write_file(written, orderfile::order_text(orders));
    const orderfile::CellOrders again = orderfile::read_order_file(written, faces);
    expect(again.cells.size() == orders.cells.size(), "the same orders again");
}

std::vector<std::string> seeds() {
    draworder::OrderOptions tree;
    draworder::OrderOptions bsp;
    bsp.method = draworder::OrderMethod::Bsp;
    return {
        "draworder 1\ncenter 1 2 3\nmetric l1\nfaces 7\ntwosided 0 1\nparents 0 0 1 2 3 4 5\n"
        "cell +-+/0/3 min 2 order 0 1 2\ncell cone 3 1 0 0 0 1 0 0 0 1 max 9 order 6 5 4\n"
        "cell half 2 1 0 0 0 0 1 0 -3 min 1 max 4 order\ncell half 0 order 0 1 2 3 4 5 6\n",
        "draworder 1\nfaces 7\nlist 0 1 2\nlist\nlist 3 4\nnode choice 0 0 1 0 node 1 node 2\n"
        "node parting 0 1 0 -1 list 0 nothing list 1 list 2\nnode sequence list 2 list 0 # c\n",
        orderfile::order_text(orderfile::cell_orders(draworder::ordered(small_model(), tree))),
        orderfile::order_text(orderfile::cell_orders(draworder::ordered(small_model(), bsp))),
    };
}

const Registered target({
    .name = "draw_order",
    .file = "input.order",
    .use = use,
    .seeds = seeds,
    .words = {"cell ", "cone ", "half ", "order ", "min ", "max ", "list ", "node choice ", "node parting ",
        "node sequence ", "nothing ", "node ", "twosided ", "parents ", "metric l2\n", "+++/0/0/0/0"},
});

} // namespace

} // namespace octant::tests::formats::draw_order_format
