#pragma once

#include "models/triangle_mesh.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/selective_refiner.h"

namespace octant::visuals::refine {

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
