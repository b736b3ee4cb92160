#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <optional>

namespace octant::models::measure {

/// Counts of what may be wrong with a mesh. Triangles share a vertex where they use the same index. Faces that use a
/// vertex twice count as degenerate and are otherwise left out.
struct MeshDefects {
    std::size_t boundary_edges = 0;     ///< Edges of one triangle only.
    std::size_t boundary_loops = 0;     ///< Closed chains of boundary edges: holes and rims.
    std::size_t non_manifold_edges = 0; ///< Edges of more than two triangles.
    /// Vertices whose triangles are not all connected by edges there.
    std::size_t non_manifold_vertices = 0;
    /// Edges of two triangles that run along it in the same direction.
    std::size_t turned_edges = 0;
    /// Faces with the same three vertices as an earlier one, in either orientation.
    std::size_t duplicate_faces = 0;
    /// Faces with a vertex twice, or lower than 1e-14 of their longest edge.
    std::size_t degenerate_faces = 0;
    std::size_t unreferenced_vertices = 0; ///< Vertices that no triangle uses.
    std::size_t shells = 0;                ///< Components connected by edges.
    long euler_characteristic = 0;         ///< Used vertices - edges + faces.
    /// The number of handles of all shells together; only for closed, oriented manifolds.
    std::optional<long> genus;

    bool operator==(const MeshDefects&) const = default;
};

/// Counts the defects of a mesh. The time is that of sorting its edges.
MeshDefects defects(const TriangleMesh& mesh);

} // namespace octant::models::measure
