#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models {

/// The index of no triangle or no vertex.
inline constexpr std::uint32_t none = ~std::uint32_t{0};

/// One edge collapse: the vertices `first` and `second` become a new one, whose number is the original mesh's vertex
/// count plus the collapse's place in the sequence.
struct Collapse {
    std::uint32_t first = none;  ///< vu, an active vertex
    std::uint32_t second = none; ///< vt, another one that shares an edge with it
    glm::dvec3 position_m{0.0};  ///< of the new vertex vs
    glm::vec3 colour{0.0F};      ///< of the new vertex; 0 where the mesh has no colours
    /// Original triangles that degenerate by this collapse. `left` lies left of the edge seen from first to second,
    /// from outside; none on a boundary, at least one is there.
    std::uint32_t left = none;
    std::uint32_t right = none;
    double error_m = 0.0; ///< the simplifier's estimate of the error from here on, never falling
};

/// A mesh and the edge collapses that simplify it, in order. A triangle of any state is one original triangle whose
/// corners are replaced by their active ancestors; it is gone when two of them are the same.
struct CollapseSequence {
    TriangleMesh original; ///< an oriented manifold, perhaps with boundary (RepairedMesh)
    std::vector<Collapse> collapses;
};

/// The mesh after the first `count` collapses: vertices and triangles in the order of their numbers, materials carried
/// along, normals left out.
TriangleMesh mesh_after(const CollapseSequence& sequence, std::size_t count);

/// The number of collapses that leave at most `faces` triangles; all of them if even they leave more.
std::size_t collapses_to_faces(const CollapseSequence& sequence, std::size_t faces);

} // namespace octant::models
