#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

namespace octant::models::measure {

/// Certified bounds of the one-sided Hausdorff distance: the largest distance from any point of one surface to another
/// surface is at least `min_hausdorff_m` and at most `max_hausdorff_m`.
struct HausdorffBounds {
    double min_hausdorff_m = 0.0;
    double max_hausdorff_m = 0.0;
    std::size_t cuts = 0; ///< the number of cuts of triangles that the search took
};

/// Mean distances from the points of one surface to another surface, over its area, from samples.
struct SampledDistance {
    double rms_m = 0.0;
    double mean_m = 0.0;
    /// The root mean square of the difference in colour to the nearest point, as a length in RGB with parts 0 to 1; 0
    /// if one of the surfaces has no colours.
    double colour_rms = 0.0;
};

struct OneWayDistance : HausdorffBounds, SampledDistance {};

/// The distances both ways between surfaces a and b. Each two-sided figure is the larger one of the two.
struct MeshDistance {
    OneWayDistance there; ///< From the points of a to b.
    OneWayDistance back;  ///< From the points of b to a.

    double min_hausdorff_m() const { return std::max(there.min_hausdorff_m, back.min_hausdorff_m); }

    double max_hausdorff_m() const { return std::max(there.max_hausdorff_m, back.max_hausdorff_m); }

    double rms_m() const { return std::max(there.rms_m, back.rms_m); }

    double mean_m() const { return std::max(there.mean_m, back.mean_m); }

    double colour_rms() const { return std::max(there.colour_rms, back.colour_rms); }
};

/// How accurately distances are measured.
struct DistanceOptions {
    /// The wanted ratio of the Hausdorff distance's upper to its lower bound, above 1.
    double tightness = 1.01;
    double negligible_m = 0.0; ///< Bounds below this need not be tight; 0 = 1e-9 of the diagonal.
    /// Sample points for each way, for RMS and mean; 0 = neither is measured. The relative error of the RMS is about
    /// (spread / RMS) / sqrt(samples), less because the samples are evenly spread: some 0.1 % by default.
    std::size_t samples = 400'000;
    int threads = 1; ///< The number of threads; it does not change the result.
    /// Only the larger one of the Hausdorff distances of the two ways need be tight.
    bool maximum_only = false;
    /// A tree over the triangles of a, if there is one already.
    std::shared_ptr<const TriangleBvh> tree_of_a{};
    /// Called between the steps of the work with how many of them are done; may be empty.
    std::function<void(int done, int steps)> progress{};
};

/// The distance between two surfaces, both ways. The Hausdorff bounds are certified: branch and bound over the
/// triangles, with rounding allowed for. They are as tight as was asked for unless that takes more than four million
/// cuts, as for surfaces at nearly the same distance everywhere. Both meshes need triangles (asserted).
MeshDistance distance(const TriangleMesh& a, const TriangleMesh& b, const DistanceOptions& options = {});

/// The Hausdorff bounds from `mesh` to `target` alone, by `tightness`, `negligible_m` (0 = rounding) and `threads` of
/// the options. Both meshes need triangles (asserted).
HausdorffBounds one_way_hausdorff(
    const TriangleMesh& mesh, const TargetSurface& target, const DistanceOptions& options);

/// How many points of a surface are sampled.
struct SampleOptions {
    std::size_t samples = 100'000;
    int threads = 1; ///< The number of threads; it does not change the result.
};

/// Measures the distances from points spread evenly over `mesh`, always the same ones for the same mesh and number, to
/// `target`. Any number of threads gives the same bits. The mesh needs triangles (asserted).
SampledDistance sampled_distance(const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options);

/// The share, 0 to 1, of the area of `mesh` that faces against `original`: the points whose triangle's normal is more
/// than 90 degrees off the normal at the nearest point of the original. In thin parts the nearest point may lie on the
/// opposite side; so a point counts only if no triangle of the original within twice the least distance, or within
/// `reach_m`, faces its way. The RMS distance is a good `reach_m` for a simplified mesh. Both meshes need triangles
/// (asserted).
double flipped_area_share(
    const TriangleMesh& mesh, const TriangleMesh& original, double reach_m = 0.0, const SampleOptions& options = {});

} // namespace octant::models::measure
