// Measures how much of a simplified surface is folded over, which distances do not show: in a thin
// part, such as a wing, a triangle of the upper side that faces downwards is near the lower side.
// Points are sampled evenly over the area, and each looks for a triangle of the original nearby
// that faces its way.
#include "models/measure/flipped_area.h"

#include "models/measure/surface_samples.h"
#include "models/measure/target_surface.h"
#include "sim/base/worker_team.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace octant::models::measure {

namespace {

/// Whether a point of a mesh counts as one that faces against `original`. `normal` is that of its
/// triangle, of any length, and `nearest` the nearest point of the original.
bool is_flipped(
    const TargetSurface& original,
    const glm::dvec3& point_m,
    const glm::dvec3& normal,
    const NearestOnMesh& nearest,
    double reach_m) {
    const auto faces_against = [&](std::uint32_t triangle) {
        return glm::dot(area_vector(original.mesh(), original.mesh().triangles[triangle]), normal) <
               0.0;
    };
    if (!faces_against(nearest.triangle)) {
        return false;
    }
    const double within_m =
        std::max(reach_m, 2.0 * std::sqrt(nearest.distance2)) + original.bvh().rounding_m();
    bool against = true;
    original.bvh().for_each_near(point_m, within_m, [&](std::uint32_t triangle) {
        against = against && (faces_against(triangle) ||
                              original.distance2_to(triangle, point_m) > within_m * within_m);
    });
    return against;
}

} // namespace

double flipped_area_share(
    const TriangleMesh& mesh, const TriangleMesh& original, const FlippedAreaOptions& options) {
    assert(!original.triangles.empty() && options.samples > 0);
    const TargetSurface target(original);
    const SurfaceSamples points(mesh, options.samples);
    std::vector<std::size_t> flipped(points.chunks(), 0);
    share_out(flipped.size(), options.threads, [&](std::size_t chunk, std::size_t) {
        std::uint32_t guess = NearestOnMesh::none;
        std::size_t count = 0;
        points.for_each(chunk, [&](const SurfacePoint& here) {
            const NearestOnMesh nearest = target.nearest(here.point_m, guess);
            guess = nearest.triangle;
            const glm::dvec3 normal = area_vector(mesh, mesh.triangles[here.triangle]);
            count += is_flipped(target, here.point_m, normal, nearest, options.reach_m) ? 1U : 0U;
        });
        flipped[chunk] = count;
    });
    const std::size_t count = std::accumulate(flipped.begin(), flipped.end(), std::size_t{0});
    return static_cast<double>(count) / static_cast<double>(options.samples);
}

} // namespace octant::models::measure
