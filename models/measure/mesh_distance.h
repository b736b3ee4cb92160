#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <functional>

namespace octant::models::measure {

/// Distances of the points of one surface to another one, metres.
struct OneWayDistance {
    double least_hausdorff_m = 0.0; ///< the largest distance is at least this ...
    double most_hausdorff_m = 0.0;  ///< ... and at most this
    double rms_m = 0.0;             ///< over the surface's area, sampled
    double mean_m = 0.0;            ///< the same
    double colour_rms = 0.0; ///< of the difference in colour to the nearest point, length in RGB
                             ///< 0..1; 0 without colours
};

/// Both ways; the two-sided figure is the larger one of both.
struct MeshDistance {
    OneWayDistance there; ///< from a to b
    OneWayDistance back;  ///< from b to a

    double least_hausdorff_m() const;
    double most_hausdorff_m() const;
    double rms_m() const;
    double mean_m() const;
    double colour_rms() const;
};

struct DistanceOptions {
    double tightness = 1.01;   ///< most / least Hausdorff distance asked for, > 1
    double negligible_m = 0.0; ///< bounds below this need not be tight; 0 = 1e-9 of the diagonal
    /// For each way, for rms and mean; 0 = neither. The relative error of the rms is about
    /// (spread / rms) / sqrt(samples), less because samples are even: some 0.1 % by default.
    std::size_t samples = 400'000;
    int threads = 1; ///< changes no figure
    /// Called between the steps of the work with how many of `steps` are done; may be empty.
    std::function<void(int done, int steps)> progress{};
};

/// Distance between two surfaces, both ways. The Hausdorff bounds are certified: by branch and
/// bound over the triangles, with rounding allowed for; they are as tight as was asked for unless
/// that takes more than four million cuts (surfaces at nearly the same distance everywhere). Both
/// meshes need triangles (asserted).
MeshDistance
distance(const TriangleMesh& a, const TriangleMesh& b, const DistanceOptions& options = {});

} // namespace octant::models::measure
