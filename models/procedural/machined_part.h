#pragma once

#include "models/triangle_mesh.h"

namespace octant::models::procedural {

/// A made-up machined part, closed, 110 mm large: a block with a rounded edge, a step and a hollow along it, tapered,
/// then swept around a bend; a flat end with a boss, chamfered, and a bore with a conical bottom in it. Flats,
/// cylinders, cones and one doubly curved sweep, all between sharp edges, cut finely and evenly: 35,600 triangles.
/// Metres.
TriangleMesh machined_part();

} // namespace octant::models::procedural
