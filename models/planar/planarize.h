#pragma once

#include "models/planar/incidences.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::models::planar {

/// Polygons flatter than this are left as they are; of others that become planar no corner is
/// farther from the plane. In the unit of the points.
inline constexpr double planar_noise = 1e-10;

/// Moves points, none farther than `max_move`, until the corners of each polygon lie in one plane
/// and what touches it lies there, too. Polygons for which that fails give up first what touches
/// them, then their own plane; they are told by `true` in the result.
std::vector<bool>
planarize(std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double max_move);

} // namespace octant::models::planar
