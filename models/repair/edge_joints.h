#pragma once

#include "models/mesh_edges.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::repair {

/// Calls `take(std::span<const Side>)` for each edge of sorted sides, as for_each_edge does. An edge that more than two
/// triangles share is several: one for each two triangles that alone named it by the same vertices in `named` (the
/// triangles before vertices were welded), and one for the rest. So shells that touch along an edge stay whole.
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

} // namespace octant::models::repair
