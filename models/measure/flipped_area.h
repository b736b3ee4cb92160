#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::measure {

struct FlippedAreaOptions {
    double reach_m = 0.0; ///< see below; the rms distance is a good choice for a simplified mesh
    std::size_t samples = 100'000;
    int threads = 1; ///< changes nothing
};

/// Share, 0..1, of the area of `mesh` that faces against `original`: points whose triangle's normal
/// is more than 90 degrees from the normal at the nearest point of the original. In thin parts the
/// nearest point may lie on the other side; so a point counts only where no triangle of the
/// original within twice the least distance, or within `reach_m`, faces the point's way. By
/// SurfaceSamples. Both meshes need triangles (asserted).
double flipped_area_share(
    const TriangleMesh& mesh, const TriangleMesh& original, const FlippedAreaOptions& options = {});

} // namespace octant::models::measure
