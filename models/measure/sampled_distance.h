#pragma once

#include "models/measure/target_surface.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::measure {

/// Distances and differences in colour over a surface's area.
struct SampledDistance {
    double rms_m = 0.0;
    double mean_m = 0.0;
    double colour_rms = 0.0; ///< 0 where one of the meshes has no colours
};

/// From SurfaceSamples of `mesh` to `target`. Any number of threads gives the same bits.
SampledDistance sampled_distance(
    const TriangleMesh& mesh, const TargetSurface& target, std::size_t samples, int threads);

} // namespace octant::models::measure
