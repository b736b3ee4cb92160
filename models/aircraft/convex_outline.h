#pragma once

#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::models::aircraft {

// Convex polygons by their corners, in order.

using Outline = std::vector<glm::dvec3>;

/// Corners nearer than this are one.
inline constexpr double coincident_distance_m = 1e-6;

/// Along the normal of the side from which the corners run counter-clockwise; as long as the area, square metres.
glm::dvec3 area_vector(const Outline& corners);

/// Whether there is more than a line or a point.
bool has_area(const Outline& corners);

/// Leaves out corners in the place of the one before.
Outline without_duplicates(const Outline& corners);

/// The part in front of a plane; few or no corners where there is none.
Outline in_front(const Outline& corners, const Plane& plane);

} // namespace octant::models::aircraft
