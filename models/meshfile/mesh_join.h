#pragma once

#include "models/meshfile/placement.h"
#include "models/triangle_mesh.h"

namespace octant::models::meshfile {

/// Adds a mesh, placed, to another. Where one of them has colours both get them, else materials
/// stay. Normals are kept where both have them. Notes are carried over.
void join_mesh(TriangleMesh& to, TriangleMesh from, const Placement& placement);

} // namespace octant::models::meshfile
