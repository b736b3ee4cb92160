#pragma once

#include "visuals/draworder/working_model.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::draworder {

/// Points at which the octants may meet so that few cells are needed, in body axes, metres; the
/// origin comes first. On each axis they have 0 or the coordinate whose plane leaves the fewest
/// cyclic edges on both of its sides; the last one is the centre of the bounding box. The faces of
/// `work` must be about the origin.
std::vector<glm::dvec3> cell_centres(const WorkingModel& work);

} // namespace octant::visuals::draworder
