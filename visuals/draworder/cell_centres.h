#pragma once

#include "visuals/draworder/working_model.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::draworder {

/// Points at which octants may meet so that few cells are needed, the model's space, the origin
/// first: on each axis either 0 or the coordinate whose plane leaves the fewest pairs on rings on
/// both its sides; and the middle of the bounding box. `work`: faces about the origin.
std::vector<glm::dvec3> cell_centres(const WorkingModel& work);

} // namespace octant::visuals::draworder
