#include "tests/fuzz/formats/small_model.h"
#include "tests/fuzz/formats/target.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

namespace octant::tests::formats::certificate_format {

namespace {

std::vector<std::string> seeds() {
    std::vector<std::string> all;
    for (const auto method : {visuals::draworder::OrderMethod::Tree, visuals::draworder::OrderMethod::Bsp}) {
        visuals::draworder::OrderOptions options;
        options.method = method;
        const auto ordered = visuals::draworder::ordered(small_model(), options);
        all.push_back(visuals::certificate::order_certificate(ordered.model, ordered.order, {}).text);
    }
    return all;
}

const Registered target({
    .name = "certificate",
    .file = "input.certificate",
    .use = [](const auto& file) { visuals::verify::verify(visuals::verify::read_certificate(file)); },
    .seeds = seeds,
    .words = {"pair ", "node ", "list ", "away ", "unproved ", "axis ", "0x1p-30", "1/3"},
});

} // namespace

} // namespace octant::tests::formats::certificate_format
