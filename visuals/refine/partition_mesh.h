#pragma once

#include "visuals/refine/active_mesh.h"

#include <cstdint>

namespace octant::visuals::refine {

enum class ColourBy {
    Nothing, ///< as the file has it
    Region,  ///< each active vertex its own colour
    Level    ///< original vertices below: one is blue, more are warmer
};

/// The active mesh with vertices coloured.
models::TriangleMesh coloured_active(visuals::refine::ActiveMesh active, ColourBy by);

/// The original mesh, numbers as in its file, coloured by the active vertex that each of its
/// vertices lies below: the partition whose graph the active mesh is. Materials and normals are
/// left out.
models::TriangleMesh
partition_mesh(const visuals::refine::SelectiveRefiner& refiner, ColourBy by = ColourBy::Region);

} // namespace octant::visuals::refine
