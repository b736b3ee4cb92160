#pragma once

#include "models/mesh_edges.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::repair {

/// Which triangles of a mesh are to be turned so that neighbours agree on which side is out.
struct ConsistentOrientation {
    std::vector<std::uint8_t> turned;   ///< one a triangle: 1 for those that are to be turned
    std::size_t count = 0;              ///< how many are
    std::size_t non_manifold_edges = 0; ///< shared by more than two triangles, which none agree over
};

/// Of each shell the fewer half is turned. Pieces of a shell that disagree along a few edges only, for their size, are
/// left as they are: bodies that touch, each of which looks its own way. `sides`: the sorted sides of the triangles;
/// `named`: as for_each_joint.
ConsistentOrientation consistent_orientation(
    std::span<const Triangle> triangles, std::span<const TriangleEdge> sides, std::span<const Triangle> named);

} // namespace octant::models::repair
