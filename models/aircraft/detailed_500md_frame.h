#pragma once

#include "models/aircraft/model_builder.h"
#include "models/aircraft/stations.h"

#include <glm/vec3.hpp>

namespace octant::models::aircraft::md500 {

// What the parts of the detailed 500MD share: the planes between them, its stations and heights (detailed_500md.cpp).

inline constexpr double roof_u = 2.10;
inline constexpr double rotor_u = 2.70;
inline constexpr Stations stations{1.95, 1.20, 0.02};

inline glm::dvec3 at(double s, double r, double u) { return stations.at(s, r, u); }

/// The main rotor and the tail rotor, which turn.
void add_rotors(ModelBuilder& model);

} // namespace octant::models::aircraft::md500
