#pragma once

#include "models/meshfile/affine_transform.h"
#include "models/triangle_mesh.h"

#include <cstdint>

namespace octant::models::meshfile {

/// Adds a mesh, placed, to another. Where one of them has colours both get them, else materials stay. Normals are kept
/// where both have them. Notes are carried over.
void join_mesh(TriangleMesh& to, TriangleMesh from, const AffineTransform& placement);

/// The triangles of `count` materials from `first_material` on, with these materials alone and with what the triangles
/// use of the rest, in the same order.
TriangleMesh part_of_materials(const TriangleMesh& mesh, std::uint32_t first_material, std::uint32_t count);

} // namespace octant::models::meshfile
