#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace octant::models {

/// Disjoint sets (union-find). The smallest element of a set is its name.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

    std::uint32_t group_of(std::uint32_t thing) {
        while (parents_[thing] != thing) {
            parents_[thing] = parents_[parents_[thing]];
            thing = parents_[thing];
        }
        return thing;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        a = group_of(a);
        b = group_of(b);
        parents_[a < b ? b : a] = a < b ? a : b;
    }

private:
    std::vector<std::uint32_t> parents_;
};

/// One side of a triangle: from corner `corner` to the next one.
struct TriangleEdge {
    std::uint32_t min_vertex = 0; ///< the smaller of its vertices
    std::uint32_t max_vertex = 0;
    std::uint32_t triangle = 0;
    std::uint8_t corner = 0;
    bool rises = true; ///< runs from min_vertex to max_vertex

    /// Its corners at the smaller and at the larger vertex.
    std::uint32_t min_corner() const { return rises ? corner : (corner + 1U) % 3U; }

    std::uint32_t max_corner() const { return rises ? (corner + 1U) % 3U : corner; }

    bool operator==(const TriangleEdge&) const = default;
};

/// The sides of all triangles, sorted by edge; sides of one edge in the order of their triangles.
std::vector<TriangleEdge> sorted_triangle_edges(std::span<const Triangle> triangles);

/// Calls `take(std::span<const TriangleEdge>)` for each edge.
template <typename Take>
void for_each_edge(std::span<const TriangleEdge> sides, Take&& take) {
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t last = first + 1;
        while (last < sides.size() && sides[last].min_vertex == sides[first].min_vertex &&
               sides[last].max_vertex == sides[first].max_vertex) {
            ++last;
        }
        take(sides.subspan(first, last - first));
        first = last;
    }
}

/// The number of connected components (shells) of an oriented manifold; shared vertices connect.
std::size_t count_shells(const TriangleMesh& mesh);

/// The number of closed boundary loops of an oriented manifold.
std::size_t count_boundary_loops(const TriangleMesh& mesh);

} // namespace octant::models
