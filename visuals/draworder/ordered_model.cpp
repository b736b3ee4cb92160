#include "visuals/draworder/ordered_model.h"

#include <utility>

namespace octant::visuals::draworder {

namespace {

OrderedModel by_paper(models::PolygonModel model, const OrderOptions& options) {
    const OctantOrders orders = paper_orders(model, options.paper);
    OrderedModel out{
        .model = std::move(model), .order = DrawOrder(orders), .cells = {}, .notes = {}};
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 signs = octant_signs(octant);
        out.cells.push_back(
            {octant_name(octant),
             {{{signs.x, 0.0, 0.0}, 0.0}, {{0.0, signs.y, 0.0}, 0.0}, {{0.0, 0.0, signs.z}, 0.0}}});
    }
    out.cyclic_cells = orders.cyclic_octants;
    return out;
}

} // namespace

OrderedModel ordered(models::PolygonModel model, const OrderOptions& options) {
    return by_paper(std::move(model), options);
}

} // namespace octant::visuals::draworder
