#pragma once

#include "models/aircraft/model_builder.h"
#include "models/aircraft/painted_solid.h"

#include <glm/vec3.hpp>

namespace octant::models::aircraft::f15 {

// What the parts of the detailed F-15 share: the planes between them, its stations and heights
// (detailed_f15.cpp).

inline constexpr double deck_u = 0.36;
inline constexpr double side_r = 1.73;
inline constexpr double line_m = 0.03; ///< width of a panel line

inline const glm::dvec3 up(0.0, 0.0, -1.0);
inline const glm::dvec3 down(0.0, 0.0, 1.0);
inline const glm::dvec3 right(0.0, 1.0, 0.0);

/// A place by station, distance to the right and height, in body axes.
inline glm::dvec3 at(double s, double r, double u) {
    return {10.40 - s, r, 0.11 - u};
}

/// A panel line around a solid at a station.
void ring_line(PaintedSolid& solid, double s);

/// Booms, stabilators and fins.
void add_tail(ModelBuilder& model);

/// The right engine's nozzle: outside, rim and the hot inside, whose faces look at the axis.
PaintedSolid nozzle();

} // namespace octant::models::aircraft::f15
