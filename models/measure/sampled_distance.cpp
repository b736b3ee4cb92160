// RMS and mean of distance and colour difference, from points spread evenly over a surface
// (surface_samples.cpp). Sums are kept for each chunk of points and added in order, so that the
// number of threads does not change the result.
#include "models/measure/sampled_distance.h"

#include "models/measure/surface_samples.h"
#include "sim/base/worker_team.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

namespace octant::models::measure {

namespace {

/// The sums over one chunk of samples.
struct Sums {
    double distances = 0.0;
    double squares = 0.0;
    double colour_squares = 0.0;
};

/// The squared difference between the colours of a point and of its nearest point.
double colour_difference2(
    const TriangleMesh& mesh,
    const SurfacePoint& here,
    const TriangleMesh& target,
    const NearestOnMesh& there) {
    const glm::dvec3 difference =
        mixed(mesh.colours, mesh.triangles[here.triangle], here.weights) -
        mixed(target.colours, target.triangles[there.triangle], there.weights);
    return glm::dot(difference, difference);
}

} // namespace

SampledDistance sampled_distance(
    const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options) {
    if (options.samples == 0) {
        return {};
    }
    const bool coloured = !mesh.colours.empty() && !target.mesh().colours.empty();
    const SurfaceSamples points(mesh, options.samples);
    std::vector<Sums> chunks(points.chunks());
    share_out(chunks.size(), options.threads, [&](std::size_t chunk, std::size_t) {
        Sums sums;
        std::uint32_t guess = NearestOnMesh::none;
        points.for_each(chunk, [&](const SurfacePoint& here) {
            const NearestOnMesh there = target.nearest(here.point_m, guess);
            guess = there.triangle;
            sums.distances += std::sqrt(there.distance2);
            sums.squares += there.distance2;
            if (coloured) {
                sums.colour_squares += colour_difference2(mesh, here, target.mesh(), there);
            }
        });
        chunks[chunk] = sums;
    });
    Sums total;
    for (const Sums& sums : chunks) {
        total.distances += sums.distances;
        total.squares += sums.squares;
        total.colour_squares += sums.colour_squares;
    }
    const auto count = static_cast<double>(options.samples);
    return {
        std::sqrt(total.squares / count),
        total.distances / count,
        std::sqrt(total.colour_squares / count)};
}

} // namespace octant::models::measure
