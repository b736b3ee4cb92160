#include "models/mesh_edges.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace octant::models {

std::vector<TriangleEdge> sorted_triangle_edges(std::span<const Triangle> triangles) {
    // By the smaller vertex sides are dealt out into the places that belong to it, and only the few of each vertex are
    // compared.
    std::vector<std::uint32_t> ends; // of each smaller vertex's places, once all are dealt out
    const auto for_each_side = [&](const auto& take) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            for (std::uint8_t k = 0; k < 3; ++k) {
                const std::uint32_t from = triangles[t][k];
                const std::uint32_t to = triangles[t][(k + 1U) % 3U];
                take(TriangleEdge{std::min(from, to), std::max(from, to), t, k, from < to});
            }
        }
    };
    for_each_side([&](const TriangleEdge& side) {
        ends.resize(std::max<std::size_t>(ends.size(), std::size_t{side.min_vertex} + 2), 0);
        ++ends[side.min_vertex + 1];
    });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<TriangleEdge> sides(triangles.size() * 3);
    for_each_side([&](const TriangleEdge& side) { sides[ends[side.min_vertex]++] = side; });
    auto first = sides.begin();
    for (const std::uint32_t end : ends) {
        const auto last = sides.begin() + static_cast<std::ptrdiff_t>(end);
        std::sort(first, last, [](const TriangleEdge& a, const TriangleEdge& b) {
            return std::tie(a.max_vertex, a.triangle, a.corner) < std::tie(b.max_vertex, b.triangle, b.corner);
        });
        first = last;
    }
    return sides;
}

std::size_t count_shells(const TriangleMesh& mesh) {
    DisjointSets shells(mesh.vertices_m.size());
    for (const Triangle& triangle : mesh.triangles) {
        shells.join(triangle[0], triangle[1]);
        shells.join(triangle[0], triangle[2]);
    }
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v) {
        count += static_cast<std::size_t>(shells.group_of(v) == v);
    }
    return count;
}

std::size_t count_boundary_loops(const TriangleMesh& mesh) {
    DisjointSets loops(mesh.vertices_m.size());
    std::vector<bool> on_boundary(mesh.vertices_m.size(), false);
    const std::vector<TriangleEdge> sides = sorted_triangle_edges(mesh.triangles);
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        if (edge.size() == 1) {
            loops.join(edge[0].min_vertex, edge[0].max_vertex);
            on_boundary[edge[0].min_vertex] = true;
            on_boundary[edge[0].max_vertex] = true;
        }
    });
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v) {
        count += static_cast<std::size_t>(on_boundary[v] && loops.group_of(v) == v);
    }
    return count;
}

} // namespace octant::models
