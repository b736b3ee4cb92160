// Puts the two measurements of a distance together, in each direction: the certified Hausdorff
// distance (hausdorff.cpp) and sampled mean values (sampled_distance.cpp). Both use one tree over
// the triangles of the other mesh.
#include "models/measure/mesh_distance.h"

#include "models/measure/hausdorff.h"
#include "models/measure/sampled_distance.h"

#include <algorithm>
#include <cassert>

namespace octant::models::measure {

double MeshDistance::least_hausdorff_m() const {
    return std::max(there.least_hausdorff_m, back.least_hausdorff_m);
}

double MeshDistance::most_hausdorff_m() const {
    return std::max(there.most_hausdorff_m, back.most_hausdorff_m);
}

double MeshDistance::rms_m() const {
    return std::max(there.rms_m, back.rms_m);
}

double MeshDistance::mean_m() const {
    return std::max(there.mean_m, back.mean_m);
}

double MeshDistance::colour_rms() const {
    return std::max(there.colour_rms, back.colour_rms);
}

namespace {

/// Tells the caller's progress function how many of the four steps are done.
class Steps {
public:
    explicit Steps(const DistanceOptions& options)
        : options_(options) {
        show();
    }

    void next() {
        ++done_;
        show();
    }

private:
    void show() const {
        constexpr int steps = 4;
        if (options_.progress) {
            options_.progress(done_, steps);
        }
    }

    const DistanceOptions& options_;
    int done_ = 0;
};

OneWayDistance one_way(
    const TriangleMesh& mesh,
    const TargetSurface& target,
    const DistanceOptions& options,
    Steps& steps) {
    HausdorffLimits limits;
    limits.tightness = options.tightness;
    limits.negligible_m = options.negligible_m;
    limits.threads = options.threads;
    const HausdorffBounds bounds = one_way_hausdorff(mesh, target, limits);
    steps.next();
    const SampledDistance sampled =
        sampled_distance(mesh, target, {.samples = options.samples, .threads = options.threads});
    steps.next();
    return {bounds.least_m, bounds.most_m, sampled.rms_m, sampled.mean_m, sampled.colour_rms};
}

} // namespace

MeshDistance
distance(const TriangleMesh& a, const TriangleMesh& b, const DistanceOptions& options) {
    assert(!a.triangles.empty() && !b.triangles.empty() && options.tightness > 1.0);
    DistanceOptions wanted = options;
    if (!(options.negligible_m > 0.0)) {
        wanted.negligible_m = 1e-9 * std::max(diagonal_m(a), diagonal_m(b));
    }
    Steps steps(options);
    MeshDistance found;
    found.there = one_way(a, TargetSurface(b), wanted, steps);
    if (options.larger_alone) {
        wanted.negligible_m = std::max(wanted.negligible_m, found.there.least_hausdorff_m);
    }
    found.back = one_way(b, TargetSurface(a), wanted, steps);
    return found;
}

} // namespace octant::models::measure
