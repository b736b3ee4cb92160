#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/formats/small_model.h"
#include "tests/fuzz/formats/target.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/ordercache/order_cache.h"

namespace octant::tests::formats::order_cache_format {

namespace {

namespace draworder = visuals::draworder;
namespace ordercache = visuals::ordercache;

std::vector<std::string> seeds() {
    std::vector<std::string> all;
    for (const auto method :
        {draworder::OrderMethod::Tree, draworder::OrderMethod::Bsp, draworder::OrderMethod::Paper}) {
        draworder::OrderOptions options;
        options.method = method;
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

} // namespace

} // namespace octant::tests::formats::order_cache_format
