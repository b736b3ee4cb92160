#pragma once

#include "models/polygons/polygon_model.h"

namespace octant::models::aircraft::test {

/// The models of models/f15-detailed.obj and models/500md-detailed.obj: F-15C, gear up, and 500MD. Body axes; the
/// origins are those of f15.obj and 500md.obj. Planes separate their convex parts, thus a painting order cuts no
/// polygon. Markings, panel lines and glass are pieces of the faces.
polygons::PolygonModel detailed_f15();
polygons::PolygonModel detailed_500md();

} // namespace octant::models::aircraft::test
