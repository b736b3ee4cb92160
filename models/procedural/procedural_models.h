#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

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

/// A coloured globe of the size that the 2005 simplification paper used: a sphere of 1 m radius with 192 meridians, 192
/// rings and two poles, 36,866 vertices and 73,728 triangles, the earth's land and sea in colours of the vertices.
/// Axes: x towards 0 degrees east on the equator, y towards 90 degrees east, z north. Vertices: north pole, rings from
/// north to south, each from 180 degrees west on eastward, south pole.
TriangleMesh globe();

/// An invented machined part, closed, 110 mm large: a block with a rounded edge, a step and a hollow along it, tapered,
/// then swept around a bend; a flat end with a boss, chamfered, and a bore with a conical bottom in it. Flats,
/// cylinders, cones and one doubly curved sweep, all between sharp edges, cut finely and evenly: 35,600 triangles.
/// Metres.
TriangleMesh machined_part();

} // namespace octant::models::procedural
