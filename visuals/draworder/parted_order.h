#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// A model ordered by dividing its polygons, and the pieces that they were cut into.
struct PartedOrder {
    models::polygons::PolygonModel model;
    DrawOrder order;
    int splits = 0; ///< How many polygons were added by cutting.
    std::vector<std::string> notes;
};

/// Orders any model for every eye by partings (visuals/parting), without a search: a part that
/// turns is taken for the body that it sweeps and painted as a whole, at every angle. Notes tell of
/// turning parts that meet something.
PartedOrder parted_order(models::polygons::PolygonModel model);

} // namespace octant::visuals::draworder
