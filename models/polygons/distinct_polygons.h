#pragma once

#include "models/polygons/polygon_model.h"

#include <cstdint>
#include <vector>

namespace octant::models::polygons {

/// The numbers of a model's polygons, ascending, but for those that a later one repeats: the same corners in the same
/// places, seen from the same side, and turning with the same part. Of polygons in one plane the later one of the file
/// is seen; a depth buffer, for which both are equally near, shows that only where the earlier one is not drawn.
std::vector<std::uint32_t> distinct_polygons(const PolygonModel& model);

} // namespace octant::models::polygons
