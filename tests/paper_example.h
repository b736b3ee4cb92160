#pragma once

#include "models/polygons/polygon_model.h"

namespace octant::tests {

/// Vertices V1 .. V14 and polygons P1 .. P10 of the 1989 paper's example (tables 2 and 3), its x, y, z taken as body
/// axes.
models::polygons::PolygonModel paper_example();

} // namespace octant::tests
