#pragma once

#include "models/triangle_mesh.h"

namespace octant::models::procedural {

/// A coloured globe of the size that the 2005 simplification paper used: a sphere of 1 m radius with 192 meridians, 192
/// rings and two poles, 36,866 vertices and 73,728 triangles, the earth's land and sea in colours of the vertices.
/// Axes: x towards 0 degrees east on the equator, y towards 90 degrees east, z north. Vertices: north pole, rings from
/// north to south, each from 180 degrees west on eastward, south pole.
TriangleMesh globe();

} // namespace octant::models::procedural
