#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <optional>

namespace octant::models::measure {

/// What may be wrong with a mesh. Vertices are shared where triangles use the same index; faces
/// that use a vertex twice are counted as degenerate and otherwise left out.
struct MeshDefects {
    std::size_t boundary_edges = 0;        ///< of one triangle only
    std::size_t boundary_loops = 0;        ///< closed ways along boundary edges: holes and rims
    std::size_t non_manifold_edges = 0;    ///< of more than two triangles
    std::size_t non_manifold_vertices = 0; ///< whose triangles are not all joined by edges there
    std::size_t turned_edges = 0;          ///< of two triangles that run along it the same way
    std::size_t duplicate_faces = 0;  ///< same three vertices as an earlier one, either way round
    std::size_t degenerate_faces = 0; ///< a vertex twice, or flat: height < 1e-14 longest edge
    std::size_t unreferenced_vertices = 0; ///< of no triangle
    std::size_t shells = 0;                ///< pieces joined by edges
    long euler_characteristic = 0;         ///< vertices used - edges + faces
    std::optional<long>
        genus; ///< handles of all shells together; only of closed, oriented manifolds

    bool operator==(const MeshDefects&) const = default;
};

MeshDefects defects(const TriangleMesh& mesh);

} // namespace octant::models::measure
