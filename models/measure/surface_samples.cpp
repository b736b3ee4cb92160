#include "models/measure/surface_samples.h"

#include "sim/base/worker_team.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

// Points k = 0, 1, ... lie at (k + 1/2) / samples of the area, counted triangle by triangle, so
// that each triangle gets its share; within the triangles they follow M. Roberts's R2 sequence,
// "The unreasonable effectiveness of quasirandom sequences", 2018, folded at the diagonal.

namespace octant::models::measure {

namespace {

/// Area of the triangles up to each one, itself included.
std::vector<double> areas_so_far(const TriangleMesh& mesh) {
    std::vector<double> areas;
    areas.reserve(mesh.triangles.size());
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto& at = mesh.vertices_m;
        sum += glm::length(glm::cross(at[b] - at[a], at[c] - at[a]));
        areas.push_back(sum);
    }
    if (!(sum > 0.0)) {
        for (std::size_t i = 0; i < areas.size(); ++i) {
            areas[i] = static_cast<double>(i + 1);
        }
    }
    return areas;
}

/// Weights of the corners at the kth point of the sequence.
glm::dvec3 weights_at(std::size_t k) {
    constexpr double plastic = 1.32471795724474602596; // x^3 = x + 1
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

template <typename Vector>
glm::dvec3
mixed(const std::vector<Vector>& values, const Triangle& triangle, const glm::dvec3& weights) {
    return weights.x * glm::dvec3(values[triangle[0]]) +
           weights.y * glm::dvec3(values[triangle[1]]) +
           weights.z * glm::dvec3(values[triangle[2]]);
}

struct Sums {
    double distances = 0.0;
    double squares = 0.0;
    double colour_squares = 0.0;
};

} // namespace

SampledDistance sampled_distance(
    const TriangleMesh& mesh, const TargetSurface& target, std::size_t samples, int threads) {
    assert(!mesh.triangles.empty() && !target.mesh().triangles.empty());
    if (samples == 0) {
        return {};
    }
    const std::vector<double> areas = areas_so_far(mesh);
    const bool coloured = !mesh.colours.empty() && !target.mesh().colours.empty();
    const auto add = [&](std::size_t k, std::size_t triangle, std::uint32_t& guess, Sums& sums) {
        const glm::dvec3 weights = weights_at(k);
        const Triangle& corners = mesh.triangles[triangle];
        const NearestOnMesh found = target.nearest(mixed(mesh.vertices_m, corners, weights), guess);
        guess = found.triangle;
        sums.distances += std::sqrt(found.distance2);
        sums.squares += found.distance2;
        if (coloured) {
            const Triangle& there = target.mesh().triangles[found.triangle];
            const glm::dvec3 difference = mixed(mesh.colours, corners, weights) -
                                          mixed(target.mesh().colours, there, found.weights);
            sums.colour_squares += glm::dot(difference, difference);
        }
    };
    constexpr std::size_t chunk = 4096; // its sums are added in order, whoever made them
    std::vector<Sums> chunks((samples + chunk - 1) / chunk);
    share_out(chunks.size(), threads, [&](std::size_t i, std::size_t) {
        std::uint32_t guess = NearestOnMesh::none;
        const auto place_of = [&](std::size_t k) {
            return areas.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(samples);
        };
        const auto start = std::ranges::upper_bound(areas, place_of(i * chunk));
        auto triangle = static_cast<std::size_t>(start - areas.begin());
        for (std::size_t k = i * chunk; k < std::min(samples, (i + 1) * chunk); ++k) {
            while (triangle + 1 < areas.size() && areas[triangle] <= place_of(k)) {
                ++triangle;
            }
            add(k, triangle, guess, chunks[i]);
        }
    });
    Sums total;
    for (const Sums& sums : chunks) {
        total.distances += sums.distances;
        total.squares += sums.squares;
        total.colour_squares += sums.colour_squares;
    }
    const auto count = static_cast<double>(samples);
    return {
        std::sqrt(total.squares / count),
        total.distances / count,
        std::sqrt(total.colour_squares / count)};
}

} // namespace octant::models::measure
