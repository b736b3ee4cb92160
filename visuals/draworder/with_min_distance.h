#pragma once

#include "visuals/draworder/draw_order.h"

#include <glm/vec3.hpp>

namespace octant::visuals::draworder {

/// An order by octants about a centre, in body axes, metres, that is meant for eyes with
/// |x| + |y| + |z| >= `distance_m` from there, with one choice more in each octant: nearer eyes are
/// painted nothing. The first three choices on each path must be planes through the centre across the axes, as
/// Method::Cells makes them (asserted).
DrawOrder with_min_distance(const DrawOrder& order, const glm::dvec3& centre_m, double distance_m);

} // namespace octant::visuals::draworder
