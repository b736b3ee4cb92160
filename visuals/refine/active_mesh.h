#pragma once

#include "models/triangle_mesh.h"
#include "visuals/refine/selective_refiner.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::refine {

/// The triangle mesh that a front of active nodes stands for, each vertex at its node's own position (without
/// geomorphs). Positions are in the axes of the original file, metres.
struct ActiveMesh {
    models::TriangleMesh mesh; ///< Triangles come in the order of their original faces.
    /// For each vertex the sequence number of its node (ProgressiveMesh::sequence_number), ascending.
    std::vector<std::uint32_t> nodes;
    /// For each vertex the numbers of the original vertices below its node, ascending: the region S(v) of the paper.
    std::vector<std::vector<std::uint32_t>> originals;
};

/// Extracts the active mesh. With the list of nodes anyone can check it against the original file: its faces are
/// {(A(a), A(b), A(c))} over the original faces whose three active ancestors A differ.
ActiveMesh active_mesh(const SelectiveRefiner& refiner);

/// The original mesh of a hierarchy, its vertices numbered as the leaves and its triangles as the faces. Materials,
/// colours and notes are kept, normals left out.
models::TriangleMesh finest_mesh(const ProgressiveMesh& hierarchy);

/// What the colours of a picture of the refinement show.
enum class ColourBy {
    Nothing, ///< No colours but those that the mesh itself has.
    Region,  ///< Each active vertex, or region S(v), has a colour of its own.
    Level    ///< How many original vertices a node stands for: blue for one, warmer for more.
};

/// The active mesh with coloured vertices.
models::TriangleMesh coloured_mesh(ActiveMesh active, ColourBy by);

/// The original mesh, vertices and faces numbered as in its file, where each vertex has the colour of its active
/// ancestor. This shows the paper's partition of the original into the regions S(v), one for each active vertex; the
/// active mesh is the graph of their adjacency. Materials and normals are left out.
models::TriangleMesh partition_mesh(const SelectiveRefiner& refiner, ColourBy by = ColourBy::Region);

} // namespace octant::visuals::refine
