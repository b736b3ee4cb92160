#include "models/repair/close_boundaries.h"

#include "models/mesh_edges.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace octant::models::repair {

namespace {

/// Of the diagonal. A float has 24 bits, a text of six digits half a millionth.
constexpr double rounding = 1e-6;

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t part : cell) {
            hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15ULL;
            hash ^= hash >> 29U;
        }
        return hash;
    }
};

std::vector<std::uint32_t> rim_vertices(const TriangleMesh& mesh) {
    std::vector<bool> on_rim(mesh.vertices_m.size(), false);
    const std::vector<TriangleEdge> sides = sorted_triangle_edges(mesh.triangles);
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        if (edge.size() == 1) {
            on_rim[edge[0].least] = true;
            on_rim[edge[0].most] = true;
        }
    });
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < on_rim.size(); ++v) {
        if (on_rim[v]) {
            vertices.push_back(v);
        }
    }
    return vertices;
}

/// Takes back what would make corners of one triangle one.
void keep_corners_apart(const TriangleMesh& mesh, std::vector<std::uint32_t>& firsts) {
    for (const Triangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t one = triangle[k];
            const std::uint32_t other = triangle[(k + 1) % 3];
            if (one != other && firsts[one] == firsts[other]) {
                firsts[one] = one;
                firsts[other] = other;
            }
        }
    }
}

} // namespace

std::vector<std::uint32_t> close_boundaries(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> firsts(mesh.vertices_m.size());
    std::iota(firsts.begin(), firsts.end(), 0U);
    const double near_m = rounding * diagonal_m(mesh);
    if (!(near_m > 0.0)) {
        return firsts;
    }
    const glm::dvec3 origin_m = bounds_of(mesh).min_m;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> kept;
    for (const std::uint32_t vertex : rim_vertices(mesh)) {
        const glm::dvec3& place_m = mesh.vertices_m[vertex];
        const glm::dvec3 scaled = (place_m - origin_m) / near_m;
        const Cell own{std::llround(scaled.x), std::llround(scaled.y), std::llround(scaled.z)};
        std::uint32_t first = vertex;
        for (int i = 0; i < 27; ++i) {
            const auto found =
                kept.find({own[0] + i % 3 - 1, own[1] + i / 3 % 3 - 1, own[2] + i / 9 - 1});
            if (found == kept.end()) {
                continue;
            }
            for (const std::uint32_t other : found->second) {
                if (glm::distance(mesh.vertices_m[other], place_m) <= near_m) {
                    first = std::min(first, other);
                }
            }
        }
        firsts[vertex] = first;
        if (first == vertex) {
            kept[own].push_back(vertex);
        }
    }
    keep_corners_apart(mesh, firsts);
    return firsts;
}

} // namespace octant::models::repair
