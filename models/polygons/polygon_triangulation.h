#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace octant::models::polygons {

/// Cuts a polygon of at least three corners into triangles between them: places in `corners_m`, turning as the polygon
/// does. A strictly convex one becomes a fan around its first corner, all others are cut ear by ear as they look along
/// their mean normal (Newell's sum), so that corners on a straight side make no triangle without an area. Always gives
/// two triangles fewer than corners, also for what crosses itself or has no area (whose triangles then may overlap).
/// Time grows with the square of the number of corners.
std::vector<std::array<std::size_t, 3>> triangulate_polygon(std::span<const glm::dvec3> corners_m);

} // namespace octant::models::polygons
