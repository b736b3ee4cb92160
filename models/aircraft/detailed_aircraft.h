#pragma once

#include "models/polygons/polygon_model.h"

namespace octant::models::aircraft {

/// The F-15C and the 500MD in detail, gear up and skids down: what models/f15-detailed.obj and
/// models/500md-detailed.obj hold. Body axes, origins as those of the plain models. Convex bodies side by side, so that
/// planes part them: their painting orders cut no polygon. Markings, panel lines and glass are pieces of the faces that
/// they lie on.
polygons::PolygonModel detailed_f15();
polygons::PolygonModel detailed_500md();

} // namespace octant::models::aircraft
