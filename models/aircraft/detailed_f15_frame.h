#pragma once

#include "models/aircraft/model_builder.h"
#include "models/aircraft/painted_solid.h"
#include "models/aircraft/stations.h"

#include <glm/vec3.hpp>

namespace octant::models::aircraft::f15 {

// What the parts of the detailed F-15 share: the planes between them, its stations and heights (detailed_f15.cpp).

inline constexpr double deck_u = 0.36;
inline constexpr double side_r = 1.73;
inline constexpr Stations stations{10.40, 0.11, 0.03};

inline glm::dvec3 at(double s, double r, double u) { return stations.at(s, r, u); }

/// Booms, stabilators and fins.
void add_tail(ModelBuilder& model);

/// The right engine's nozzle: outside, rim and the hot inside, whose faces look at the axis.
PaintedSolid nozzle();

} // namespace octant::models::aircraft::f15
