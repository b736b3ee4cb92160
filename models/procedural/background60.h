#pragma once

#include "models/polygons/polygon_model.h"

namespace octant::models::procedural {

/// A background of 60 polygons in the manner of the 1989 draw-order paper, whose own is not printed: 24 mountains, then
/// 36 pieces of ground.
///
/// Axes: body x = north, body y = east, body z = down, metres, origin in the middle of the ground. The mountains stand
/// upright on the sides of a regular 24-gon with its corners 14 km from the origin (the first one north), each on one
/// side, facing inward, 300 to 1,500 m high. The ground is the 24-gon at height 0 in fields, a river of 350 m width in
/// three reaches and a runway of 3 km x 60 m that runs north-south 1.2 km east of the origin, all facing up. Every
/// polygon has the corners of its neighbours on its own sides too, so that no cracks show.
///
/// Painted in file order the picture is exact for every eye above the ground and inside the ring: along no line of
/// sight does one polygon that faces the eye lie behind another.
polygons::PolygonModel background60();

/// The torus of the 2008 hybrid-shading paper, which prints its 416 quads but not its shape: a ring of 1 m radius
/// around the body z axis, 0.4 m thick in radius, cut into `around` x `across` quads (at least 3 each, asserted). All
/// quads are planar and convex, face outward and follow one another around the axis, ring after ring; one part, one
/// material.
polygons::PolygonModel torus(int around = 26, int across = 16);

} // namespace octant::models::procedural
