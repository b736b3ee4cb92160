#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::measure {

/// How finely flipped_area_share looks.
struct FlippedAreaOptions {
    /// How far around a point a face that faces its way may be, metres; see below. The RMS distance is a good choice
    /// for a simplified mesh.
    double reach_m = 0.0;
    std::size_t samples = 100'000;
    int threads = 1; ///< The number of threads; it does not change the result.
};

/// The share, 0 to 1, of the area of `mesh` that faces against `original`: the points whose triangle's normal is more
/// than 90 degrees off the normal at the nearest point of the original. In thin parts the nearest point may lie on the
/// opposite side; so a point counts only if no triangle of the original within twice the least distance, or within
/// `reach_m`, faces its way. Both meshes need triangles (asserted).
double flipped_area_share(
    const TriangleMesh& mesh, const TriangleMesh& original, const FlippedAreaOptions& options = {});

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

/// Measures the distances from points spread evenly over `mesh`, always the same ones for the same mesh and number, to
/// `target`. Any number of threads gives the same bits. The mesh needs triangles (asserted).
SampledDistance sampled_distance(const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options);

} // namespace octant::models::measure
