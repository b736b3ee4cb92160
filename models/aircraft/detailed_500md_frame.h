#pragma once

#include "models/aircraft/model_builder.h"

#include <glm/vec3.hpp>

namespace octant::models::aircraft::md500 {

// What the parts of the detailed 500MD share: the planes between them, its stations and heights
// (detailed_500md.cpp).

inline constexpr double roof_u = 2.10;
inline constexpr double rotor_u = 2.70;
/// The width of a panel line.
inline constexpr double line_m = 0.02;

inline const glm::dvec3 up(0.0, 0.0, -1.0);
inline const glm::dvec3 right(0.0, 1.0, 0.0);

/// A place by station, distance to the right and height, in body axes.
inline glm::dvec3 at(double s, double r, double u) {
    return {1.95 - s, r, 1.20 - u};
}

/// The main rotor and the tail rotor, which turn.
void add_rotors(ModelBuilder& model);

} // namespace octant::models::aircraft::md500
