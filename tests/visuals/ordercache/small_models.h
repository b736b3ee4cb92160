#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"

#include <string>

namespace octant::tests {

/// f15, 500md or concave.
models::polygons::PolygonModel shipped_model(const std::string& name);

/// Two rectangles that pass through one another: one of them must be split.
models::polygons::PolygonModel crossing_plates();

/// Checks that two ordered models are the same, bit for bit, and that all that a drawing takes from them is.
void check_same(const visuals::draworder::OrderedModel& one, const visuals::draworder::OrderedModel& other);

} // namespace octant::tests
