#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"

#include <functional>

namespace octant::visuals::draworder {

/// Whether a model has transparent polygons (models::is_transparent).
bool has_transparent_polygons(const models::polygons::PolygonModel& model);

/// An order for a model that is drawn by depth: first all opaque polygons in file order, without those that a later one
/// repeats (models::polygons::distinct_polygons), then the transparent ones as `order_of` sorts them, to be blended
/// over the opaque ones. `order_of` gets the model of the transparent polygons alone.
OrderedModel opaque_first(const models::polygons::PolygonModel& model,
    const std::function<OrderedModel(models::polygons::PolygonModel)>& order_of);

} // namespace octant::visuals::draworder
