#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/ray_check.h"

#include <string>

namespace octant::tests {

/// A model that comes with the program, by its file's name without ending.
models::polygons::PolygonModel shipped(const std::string& name);

visuals::draworder::OrderedModel
by(visuals::draworder::Method method, models::polygons::PolygonModel model);

/// From inside the model outwards.
visuals::orderfile::EyeSamples all_eyes(int eyes);

} // namespace octant::tests
