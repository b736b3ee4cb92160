// RMS and mean of distance and colour difference, and how much of a simplified surface is folded over, from points
// spread evenly over a surface. Sums are kept for each chunk of points and added in order, so that the number of
// threads does not change the result.
//
// Point k = 0, 1, ... lies at (k + 1/2) / samples of the accumulated area, so that each triangle gets its share
// (stratified sampling). Within the triangles the points follow the R2 sequence of M. Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018: a Kronecker sequence in the unit square, folded at its diagonal.
//
// Distances do not show what is folded over: in a thin part, such as a wing, a triangle of the upper side that faces
// downwards is near the lower side. So each point looks for a triangle of the original nearby that faces its way.
#include "models/measure/sampled_distance.h"

#include "sim/base/parallel_for.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

namespace octant::models::measure {

namespace {

/// A point on a mesh's surface.
struct SurfacePoint {
    std::size_t triangle = 0;
    glm::dvec3 weights{0.0}; ///< The barycentric weights of the triangle's corners.
    glm::dvec3 point_m{0.0};
};

/// The values at the corners of a triangle, mixed by barycentric weights.
template <typename Vector>
glm::dvec3 mixed(const std::vector<Vector>& values, const Triangle& triangle, const glm::dvec3& weights) {
    return weights.x * glm::dvec3(values[triangle[0]]) + weights.y * glm::dvec3(values[triangle[1]]) +
           weights.z * glm::dvec3(values[triangle[2]]);
}

/// For each triangle twice the accumulated area up to and including it; its number and one more on a mesh without area.
std::vector<double> accumulated_areas(const TriangleMesh& mesh) {
    std::vector<double> areas;
    areas.reserve(mesh.triangles.size());
    double sum = 0.0;
    for (const Triangle& triangle : mesh.triangles) {
        sum += glm::length(area_vector(mesh, triangle));
        areas.push_back(sum);
    }
    for (std::size_t i = 0; i < areas.size() && !(sum > 0.0); ++i) { areas[i] = static_cast<double>(i + 1); }
    return areas;
}

/// The barycentric weights of point k in its triangle.
glm::dvec3 weights_of(std::size_t k) {
    // The plastic number, the real root of x^3 = x + 1.
    constexpr double plastic = 1.32471795724474602596;
    const double n = static_cast<double>(k) + 1.0;
    double unused = 0.0;
    double u = std::modf(0.5 + n / plastic, &unused);
    double v = std::modf(0.5 + n / (plastic * plastic), &unused);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {1.0 - u - v, u, v};
}

/// The sums over one chunk of samples.
struct Sums {
    double distances = 0.0;
    double squares = 0.0;
    double colour_squares = 0.0;
    std::size_t flipped = 0;
};

/// Calls `take(sums, point, nearest)` with each point of a mesh and the nearest one of the target, on several threads.
/// Returns all sums.
template <typename Take>
Sums summed(const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options, const Take& take) {
    assert(!mesh.triangles.empty());
    constexpr std::size_t chunk_size = 4096;
    const std::vector<double> areas = accumulated_areas(mesh);
    const auto count = static_cast<double>(options.samples);
    const auto area_before = [&](std::size_t k) { return areas.back() * (static_cast<double>(k) + 0.5) / count; };
    std::vector<Sums> chunks((options.samples + chunk_size - 1) / chunk_size);
    parallel_for(chunks.size(), options.threads, [&](std::size_t chunk, std::size_t) {
        const std::size_t first = chunk * chunk_size;
        auto triangle = static_cast<std::size_t>(std::ranges::upper_bound(areas, area_before(first)) - areas.begin());
        Sums sums;
        std::uint32_t guess = NearestOnMesh::none;
        for (std::size_t k = first; k < std::min(options.samples, first + chunk_size); ++k) {
            while (triangle + 1 < areas.size() && areas[triangle] <= area_before(k)) { ++triangle; }
            const glm::dvec3 weights = weights_of(k);
            const glm::dvec3 point_m = mixed(mesh.vertices_m, mesh.triangles[triangle], weights);
            const NearestOnMesh nearest = target.nearest(point_m, guess);
            guess = nearest.triangle;
            take(sums, SurfacePoint{triangle, weights, point_m}, nearest);
        }
        chunks[chunk] = sums;
    });
    Sums total;
    for (const Sums& sums : chunks) {
        total.distances += sums.distances;
        total.squares += sums.squares;
        total.colour_squares += sums.colour_squares;
        total.flipped += sums.flipped;
    }
    return total;
}

/// Whether a point of a mesh counts as one that faces against `original`. `normal` is that of its triangle, of any
/// length, and `nearest` the nearest point of the original.
bool is_flipped(const TargetSurface& original, const glm::dvec3& point_m, const glm::dvec3& normal,
    const NearestOnMesh& nearest, double reach_m) {
    const auto faces_against = [&](std::uint32_t triangle) {
        return glm::dot(area_vector(original.mesh(), original.mesh().triangles[triangle]), normal) < 0.0;
    };
    if (!faces_against(nearest.triangle)) { return false; }
    const double within_m = std::max(reach_m, 2.0 * std::sqrt(nearest.distance2)) + original.bvh().rounding_m();
    bool against = true;
    original.bvh().for_each_near(point_m, within_m, [&](std::uint32_t triangle) {
        against =
            against && (faces_against(triangle) || original.distance2_to(triangle, point_m) > within_m * within_m);
    });
    return against;
}

} // namespace

double flipped_area_share(const TriangleMesh& mesh, const TriangleMesh& original, const FlippedAreaOptions& options) {
    assert(!original.triangles.empty() && options.samples > 0);
    const TargetSurface target(original);
    const auto take = [&](Sums& sums, const SurfacePoint& here, const NearestOnMesh& nearest) {
        const glm::dvec3 normal = area_vector(mesh, mesh.triangles[here.triangle]);
        sums.flipped += is_flipped(target, here.point_m, normal, nearest, options.reach_m) ? 1U : 0U;
    };
    const Sums sums = summed(mesh, target, {options.samples, options.threads}, take);
    return static_cast<double>(sums.flipped) / static_cast<double>(options.samples);
}

SampledDistance sampled_distance(const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options) {
    if (options.samples == 0) { return {}; }
    const TriangleMesh& other = target.mesh();
    const bool coloured = !mesh.colours.empty() && !other.colours.empty();
    const auto take = [&](Sums& sums, const SurfacePoint& here, const NearestOnMesh& there) {
        sums.distances += std::sqrt(there.distance2);
        sums.squares += there.distance2;
        if (coloured) {
            const glm::dvec3 difference = mixed(mesh.colours, mesh.triangles[here.triangle], here.weights) -
                                          mixed(other.colours, other.triangles[there.triangle], there.weights);
            sums.colour_squares += glm::dot(difference, difference);
        }
    };
    const Sums total = summed(mesh, target, options, take);
    const auto count = static_cast<double>(options.samples);
    return {std::sqrt(total.squares / count), total.distances / count, std::sqrt(total.colour_squares / count)};
}

} // namespace octant::models::measure
