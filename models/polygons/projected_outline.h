#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::polygons {

/// Corners as they look along the mean normal (Newell's sum) of their polygon, metres from the first one: an outline
/// that runs counter-clockwise. The polygon has an area.
std::vector<glm::dvec2> projected_outline(std::span<const glm::dvec3> corners_m);

/// Positive when the path a -> b -> c turns left: twice the area of the triangle.
double turn_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

/// The first two sides of an outline that meet anywhere but at a common corner, by the places of their first corners;
/// also neighbours that fold back onto one another. Time grows with the square of the number of corners.
std::optional<std::pair<std::size_t, std::size_t>> intersecting_sides(std::span<const glm::dvec2> outline);

} // namespace octant::models::polygons
