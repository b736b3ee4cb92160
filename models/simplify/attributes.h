#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

namespace octant::models::simplify {

/// Gives the mesh corner normals where the original has any: those of the original surface near
/// each corner, of a triangle that faces as the corner's does, so that sharp edges stay sharp.
/// `bvh` is the original's.
void take_normals(
    TriangleMesh& mesh, const TriangleMesh& original, const measure::TriangleBvh& bvh);

} // namespace octant::models::simplify
