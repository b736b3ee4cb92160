#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/draw_order.h"

#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// A model whose polygons were split until they have an order, and that order.
struct BspOrder {
    models::polygons::PolygonModel model;
    DrawOrder order;
    int splits = 0;                 ///< How many polygons were added.
    std::vector<std::string> notes; ///< On turning parts that no order paints correctly.
};

/// The order that every model has, right for every eye: its polygons are split by planes where they hide one another in
/// a cycle. One that turns is replaced by the solid that it sweeps and never split.
BspOrder order_by_splitting(models::polygons::PolygonModel model);

/// A tree of view splits; some of its cells have no list yet.
struct IncompleteOrder {
    std::vector<DrawOrder::Node> nodes; ///< As DrawOrder takes them; at least one.
    std::vector<std::vector<std::uint32_t>> lists;
    /// For each cell without a list the sets of polygons that are painted one after the other; empty for others.
    std::vector<std::vector<std::vector<std::uint32_t>>> incomplete_cells;
    /// For each polygon of the model its plane, in body axes; those of slivers are not computed from their corners.
    std::vector<Plane> planes;
};

/// Completes the cells without a list: the polygons of each set of theirs are split where they hide one another in a
/// cycle.
BspOrder complete_by_splitting(models::polygons::PolygonModel model, const IncompleteOrder& incomplete);

} // namespace octant::visuals::draworder
