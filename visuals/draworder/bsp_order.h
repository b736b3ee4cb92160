#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// How far polygons are divided.
enum class BspLeaves {
    Clusters, ///< Where they hide one another in rings.
    Single    ///< Until each stands alone: a BSP tree.
};

/// A model ordered by dividing its polygons, and the pieces that they were cut into.
struct BspOrder {
    models::polygons::PolygonModel model;
    DrawOrder order;
    int splits = 0; ///< How many polygons were added by cutting.
    std::vector<std::string> notes;
};

/// Orders any model for every eye by partings (visuals/bsp), without a search. A polygon that
/// turns is taken for what it sweeps and never cut, so that the order holds at every angle. Notes
/// tell of turning parts that no plane parts from others.
BspOrder bsp_order(models::polygons::PolygonModel model, BspLeaves way = BspLeaves::Clusters);

/// A tree of choices of which some cells have no list yet.
struct IncompleteOrder {
    std::vector<DrawOrder::Node> nodes; ///< As DrawOrder takes them; at least one.
    std::vector<std::vector<std::uint32_t>> lists;
    /// For each cell without a list the sets of polygons that are painted one after the other;
    /// empty for others.
    std::vector<std::vector<std::vector<std::uint32_t>>> incomplete_cells;
    /// For each polygon of the model its plane, in body axes: slivers are not asked for theirs.
    std::vector<Plane> planes;
};

/// Orders the open cells by dividing their sets: what hides nothing in a ring for the eyes of a
/// cell is not parted, and found lists take up the pieces that are cut.
BspOrder complete_order(models::polygons::PolygonModel model, IncompleteOrder order);

} // namespace octant::visuals::draworder
