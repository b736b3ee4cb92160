// Painting orders: their files, caches and certificates.
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/formats/samples.h"
#include "tests/fuzz/formats/target.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/ordercache/order_cache.h"
#include "visuals/orderfile/order_text.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

namespace octant::tests::formats {

namespace {

namespace certificate {

std::vector<std::string> seeds() {
    std::vector<std::string> all;
    for (const double search_s : {20.0, 0.0}) {
        const auto ordered = visuals::draworder::ordered(small_model(), {.seconds = search_s});
        all.push_back(visuals::certificate::order_certificate({ordered.model, ordered.order, {}, {"model", "0"}}).text);
    }
    return all;
}

const Registered target({
    .name = "certificate",
    .file = "input.certificate",
    .use = [](const auto& file) { visuals::verify::verify(visuals::verify::CertificateReader(file)); },
    .seeds = seeds,
    .words = {"pair ", "node ", "list ", "away ", "unproved ", "axis ", "0x1p-30", "1/3"},
});

} // namespace certificate

namespace draw_order {

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
    return {
        "draworder 1\ncenter 1 2 3\nmetric l1\nfaces 7\ntwosided 0 1\nparents 0 0 1 2 3 4 5\n"
        "cell +-+/0/3 min 2 order 0 1 2\ncell cone 3 1 0 0 0 1 0 0 0 1 max 9 order 6 5 4\n"
        "cell half 2 1 0 0 0 0 1 0 -3 min 1 max 4 order\ncell half 0 order 0 1 2 3 4 5 6\n",
        "draworder 1\nfaces 7\nlist 0 1 2\nlist\nlist 3 4\nnode choice 0 0 1 0 node 1 node 2\n"
        "node parting 0 1 0 -1 list 0 nothing list 1 list 2\nnode sequence list 2 list 0 # c\n",
        orderfile::order_text(orderfile::cell_orders(draworder::ordered(small_model()))),
        orderfile::order_text(orderfile::cell_orders(draworder::ordered(small_model(), {.seconds = 0.0}))),
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

} // namespace draw_order

namespace order_cache {

namespace draworder = visuals::draworder;
namespace ordercache = visuals::ordercache;

std::vector<std::string> seeds() {
    std::vector<std::string> all;
    const draworder::OrderOptions split_at_once{.seconds = 0.0};
    const draworder::OrderOptions paper{.method = draworder::OrderMethod::Paper};
    for (const draworder::OrderOptions& options : {draworder::OrderOptions(), split_at_once, paper}) {
        all.push_back(ordercache::encode_order(draworder::ordered(small_model(), options)));
    }
    return all;
}

/// Paints for some eyes, and keeps the order again.
void use(const std::filesystem::path& file) {
    const std::string bytes = read_file(file);
    draworder::OrderedModel ordered = [&] {
        try {
            return ordercache::decode_order(bytes, small_model());
        } catch (const Error& refusal) { throw_error_in(file, refusal.what()); }
    }();
    draworder::DrawOrder::Walk walk;
    for (const glm::dvec3& eye_m : some_eyes()) {
        std::vector<std::uint32_t> painted;
        ordered.order.append_painted(eye_m, walk, painted);
        for (const std::uint32_t polygon : painted) {
            expect(polygon < ordered.model.polygons.size(), "polygons that are there");
            for (const std::uint32_t corner : ordered.model.corners(polygon)) {
                expect(corner < ordered.model.vertices_m.size(), "corners that are there");
            }
        }
    }
    const std::string again = ordercache::encode_order(ordered);
    expect(ordercache::encode_order(ordercache::decode_order(again, small_model())) == again, "the same order again");
}

const Registered target({.name = "order_cache", .file = "input.kept", .use = use, .seeds = seeds});

} // namespace order_cache

} // namespace

} // namespace octant::tests::formats
