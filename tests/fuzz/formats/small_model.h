#pragma once

#include "models/polygons/polygon_model.h"

#include <vector>

namespace octant::tests::formats {

/// A box with a wall beside it: 7 polygons that hide one another, and a part that turns.
models::polygons::PolygonModel small_model();

/// Eyes near and far, also in the middle of things.
std::vector<glm::dvec3> some_eyes();

} // namespace octant::tests::formats
