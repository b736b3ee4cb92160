#pragma once

#include "sim/trajectory.h"
#include "ui/world/world.h"

#include <glm/vec3.hpp>

#include <memory>

namespace octant::tests {

/// A straight flight from `from_m` at a steady speed, heading where it goes, with 20 samples a second.
sim::Trajectory straight_flight(const glm::dvec3& from_m, const glm::dvec3& velocity_mps, double length_s);

/// So many tetrahedra of a metre that fly 10 s north at 100 m/s, 300 m above level ground of 4 by 4 km at a height of
/// 0.
ui::world::World small_world(int aircraft = 1);

/// Ground of 4 by 4 km at a height of 0, and at this height in its northern quarter.
std::shared_ptr<const visuals::landscape::Ground> ground_with_plateau(double height_m);

} // namespace octant::tests
