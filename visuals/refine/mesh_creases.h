#pragma once

#include "models/triangle_mesh.h"
#include "visuals/refine/progressive_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::refine {

/// The normals of a face's corners.
using CornerNormals = std::array<PackedNormal, 3>;

/// Where a hierarchy's surface has several normals at one vertex: at edges that are to be seen. Every face of an active
/// mesh is an original face, whose own corner normals are drawn at creased nodes, the nodes' normals elsewhere.
struct MeshCreases {
    std::vector<CornerNormals> corner_normals; ///< one for each face of the hierarchy
    std::vector<bool> is_creased;              ///< for each node: a vertex below it has several normals
};

/// The corner normals of a mesh from which a hierarchy is made, triangle after triangle; none where each vertex has one
/// normal only, or where the mesh has no normals.
std::vector<CornerNormals> creased_normals(const models::TriangleMesh& mesh);

/// `corner_normals`: of creased_normals, for the mesh that the hierarchy was made of, whose triangles are numbered by
/// ProgressiveMesh::original_face. Null where there are none, or not as many as faces.
std::shared_ptr<const MeshCreases> mesh_creases(
    const ProgressiveMesh& hierarchy, const std::vector<CornerNormals>& corner_normals);

} // namespace octant::visuals::refine
