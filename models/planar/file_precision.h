#pragma once

#include <glm/vec3.hpp>

#include <span>

namespace octant::models::planar {

/// The step in which the large coordinates of a file were written, in their unit: 1e-6 for six
/// decimals (any power of ten that is well above rounding), the spacing of single precision where
/// every coordinate has it, else the spacing of double precision. Coordinates below a tenth of the
/// largest one do not count, as their decimals can be finer. `points` must not be empty (asserted).
double file_precision(std::span<const glm::dvec3> points);

/// The largest power of ten of which all coordinates are multiples but for rounding; 0 where there
/// is none.
double decimal_grid(std::span<const glm::dvec3> points);

} // namespace octant::models::planar
