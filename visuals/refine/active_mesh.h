#pragma once

#include "models/triangle_mesh.h"
#include "visuals/refine/selective_refiner.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::refine {

/// The mesh that a front stands for, nodes where they belong (no geomorphs).
struct ActiveMesh {
    models::TriangleMesh mesh; ///< triangles in the order of their original faces
    /// The sequence number of each vertex's node, rising.
    std::vector<std::uint32_t> nodes;
    std::vector<std::vector<std::uint32_t>> originals; ///< the original vertices below each, rising
};

ActiveMesh active_mesh(const SelectiveRefiner& refiner);

} // namespace octant::visuals::refine
