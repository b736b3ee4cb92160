#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/random_ray_test.h"

#include <string>

namespace octant::tests {

/// A model that comes with the program, by its file's name without ending.
models::polygons::PolygonModel shipped(const std::string& name);

visuals::draworder::OrderedModel by(visuals::draworder::OrderMethod method, models::polygons::PolygonModel model);

/// From inside the model outwards.
visuals::orderfile::RaySampling all_eyes(int eyes);

} // namespace octant::tests
