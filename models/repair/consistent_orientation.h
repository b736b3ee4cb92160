#pragma once

#include "models/mesh_edges.h"
#include "models/triangle_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::repair {

/// Calls `take(std::span<const TriangleEdge>)` for each edge of the sorted sides, as for_each_edge does. An edge of
/// more than two triangles is split: one call for each two triangles that alone named it by the same vertices in
/// `named` (the triangles before welding), and one for the rest. This keeps shells that touch along an edge intact.
template <typename Take>
void for_each_joint(std::span<const TriangleEdge> sides, std::span<const Triangle> named, Take&& take) {
    const auto name_of = [&](const TriangleEdge& side) {
        const Triangle& triangle = named[side.triangle];
        return std::pair<std::uint32_t, std::uint32_t>(
            std::minmax(triangle[side.corner], triangle[(side.corner + 1U) % 3U]));
    };
    std::vector<TriangleEdge> sorted;
    std::vector<TriangleEdge> rest;
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        if (edge.size() <= 2) {
            take(edge);
            return;
        }
        sorted.assign(edge.begin(), edge.end());
        std::ranges::stable_sort(sorted, {}, name_of);
        rest.clear();
        for (std::size_t first = 0; first < sorted.size();) {
            std::size_t last = first + 1;
            while (last < sorted.size() && name_of(sorted[last]) == name_of(sorted[first])) { ++last; }
            const std::span<const TriangleEdge> alike(sorted.data() + first, last - first);
            if (alike.size() == 2) {
                take(alike);
            } else {
                rest.insert(rest.end(), alike.begin(), alike.end());
            }
            first = last;
        }
        if (!rest.empty()) { take(std::span<const TriangleEdge>(rest)); }
    });
}

/// The triangles of a mesh that must be reversed so that neighbours have the same orientation.
struct ConsistentOrientation {
    std::vector<std::uint8_t> turned;   ///< for each triangle 1 if it must be reversed
    std::size_t count = 0;              ///< number of reversed triangles
    std::size_t non_manifold_edges = 0; ///< with more than two triangles; they impose no orientation
};

/// Reverses the minority of each shell. Pieces of a shell that disagree along few edges for their size are not changed:
/// they are separate bodies that touch. `sides` are the sorted sides of the triangles, `named` is as in for_each_joint.
ConsistentOrientation consistent_orientation(
    std::span<const Triangle> triangles, std::span<const TriangleEdge> sides, std::span<const Triangle> named);

} // namespace octant::models::repair
