#include "visuals/certificate/order_certificate.h"

#include "visuals/certificate/certificate_text.h"

#include <utility>

namespace octant::visuals::certificate {

OrderCertificate order_certificate(
    const models::polygons::PolygonModel& model,
    const draworder::DrawOrder& order,
    const models::polygons::FileAxes& axes,
    const std::function<void(std::size_t, std::size_t)>& progress) {
    const std::size_t parts = order.nodes().size() + static_cast<std::size_t>(order.cell_count());
    OrderCertificate best;
    for (const double tolerance : separation::proof_tolerances_sizes) {
        const separation::LocalModel local = separation::local_model(model, axes, tolerance);
        CertificateText text(local.size_m, [&, done = std::size_t{0}]() mutable {
            if (progress) {
                progress(++done, parts);
            }
        });
        text.add_model(model, local, axes);
        text.add_tree(order, local, axes);
        draworder::visit_proof({model, order, axes, local}, text);
        OrderCertificate made{text.take(), text.unproved()};
        if (best.text.empty() || made.unproved < best.unproved) {
            best = std::move(made);
        }
        if (best.unproved == 0) {
            break;
        }
    }
    return best;
}

} // namespace octant::visuals::certificate
