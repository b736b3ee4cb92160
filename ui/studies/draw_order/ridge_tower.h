#pragma once

#include "ui/world/world.h"

#include <glm/vec3.hpp>

namespace octant::ui::studies::draw_order {

/// An eye point on the ground from which ridges come before the aircraft and leave it again as
/// often as can be found: of places around the middle of the flight, the one from which it is
/// hidden or seen anew most often. World axes, metres.
glm::dvec3 ridge_tower(const world::World& world);

} // namespace octant::ui::studies::draw_order
