#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"

#include <string>
#include <string_view>

namespace octant::visuals::ordercache {

/// All that decides which order a model gets: its corners, polygons, parts and pivots, and the
/// options. The names of the model and its materials, and colours, are not in it.
std::string
encode_key(const models::polygons::PolygonModel& model, const draworder::OrderOptions& options);

/// An ordered model without what it has from the model as given (decode_order).
std::string encode_order(const draworder::OrderedModel& ordered);

/// The inverse of encode_order, bit for bit. `given` is the model that was ordered; names,
/// materials, parts and pivots are its own. The bytes may be anything: every number that leads to
/// something is checked. Throws Error "expected ..., got ...".
draworder::OrderedModel
decode_order(std::string_view bytes, const models::polygons::PolygonModel& given);

} // namespace octant::visuals::ordercache
