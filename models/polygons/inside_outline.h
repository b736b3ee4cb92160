#pragma once

#include <glm/vec3.hpp>

#include <span>

namespace octant::models::polygons {

/// Whether a point of an outline's plane lies inside it (even-odd; points on a side may be either). It asks the
/// corners, not the lines of the sides: the line of a side as short as the rounding of its ends has any direction, and
/// would cut anything away.
/// @param normal across the plane, of any length
bool is_inside(std::span<const glm::dvec3> corners, const glm::dvec3& normal, const glm::dvec3& point);

/// The distance of a point from the nearest side of an outline, from its end where that is nearer.
double distance_to_sides(std::span<const glm::dvec3> corners, const glm::dvec3& point);

} // namespace octant::models::polygons
