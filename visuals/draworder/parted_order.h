#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// How far polygons are divided.
enum class Parting {
    Clusters, ///< Where they hide one another in rings.
    Single    ///< Until each stands alone: a BSP tree.
};

/// A model ordered by dividing its polygons, and the pieces that they were cut into.
struct PartedOrder {
    models::polygons::PolygonModel model;
    DrawOrder order;
    int splits = 0; ///< How many polygons were added by cutting.
    std::vector<std::string> notes;
};

/// Orders any model for every eye by partings (visuals/parting), without a search. A polygon that
/// turns is taken for what it sweeps and never cut, so that the order holds at every angle. Notes
/// tell of turning parts that no plane parts from others.
PartedOrder parted_order(models::polygons::PolygonModel model, Parting way = Parting::Clusters);

} // namespace octant::visuals::draworder
