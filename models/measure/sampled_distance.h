#pragma once

#include "models/measure/target_surface.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::measure {

/// Mean values over a surface's area, from samples.
struct SampledDistance {
    double rms_m = 0.0;
    double mean_m = 0.0;
    /// In RGB with parts 0 to 1; 0 where one of the meshes has no colours.
    double colour_rms = 0.0;
};

/// Measures the distances from SurfaceSamples of `mesh` to `target`. Any number of threads gives
/// the same bits.
SampledDistance sampled_distance(
    const TriangleMesh& mesh, const TargetSurface& target, std::size_t samples, int threads);

} // namespace octant::models::measure
