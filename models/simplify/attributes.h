#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

namespace octant::models::simplify {

/// Gives a simplified mesh corner normals if the original has any. Each corner takes the original's
/// normal near its position, from a triangle that faces as its own does, so that sharp edges stay
/// sharp. `bvh` is the tree over the original.
void take_normals(
    TriangleMesh& mesh, const TriangleMesh& original, const measure::TriangleBvh& bvh);

} // namespace octant::models::simplify
