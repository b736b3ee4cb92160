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

/// What sampled_distance measures.
struct SampleOptions {
    std::size_t samples = 0;
    int threads = 1; ///< The number of threads; it does not change the result.
};

/// Measures the distances from SurfaceSamples of `mesh` to `target`. Any number of threads gives
/// the same bits.
SampledDistance sampled_distance(
    const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options);

} // namespace octant::models::measure
