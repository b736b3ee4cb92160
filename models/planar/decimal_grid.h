#pragma once

#include <glm/vec3.hpp>

#include <span>

namespace octant::models::planar {

/// The largest power of ten of which all coordinates are multiples but for rounding; 0 where there
/// is none.
double decimal_grid(std::span<const glm::dvec3> points);

} // namespace octant::models::planar
