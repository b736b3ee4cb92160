#pragma once

#include "visuals/draworder/occlusion_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// The cyclic part of a hiding graph: its strongly connected components of two or more polygons, and the edges within
/// them.
struct CyclicPart {
    std::vector<std::uint32_t> polygons; ///< The polygons of all components, ascending.
    /// The polygons of each component, ascending.
    std::vector<std::vector<std::uint32_t>> components;
    OcclusionGraph inner;  ///< The edges within components.
    std::size_t edges = 0; ///< The number of these edges.
};

/// Finds the cyclic part by R. Tarjan, "Depth-first search and linear graph algorithms", 1972. Only the polygons
/// `among` and the edges between them are looked at.
CyclicPart cyclic_part_of(const OcclusionGraph& graph, std::span<const std::uint32_t> among);

/// The cyclic part among all polygons.
CyclicPart cyclic_part_of(const OcclusionGraph& graph);

/// A cycle with the fewest polygons ("ring"): each is hidden by the next, and the last by the first. Empty when there
/// is no cycle. The search starts from the polygons `among`.
std::vector<std::uint32_t> shortest_cycle(const OcclusionGraph& graph, std::span<const std::uint32_t> among);

/// Counts the edges that lie within strongly connected components, for many variants of one graph in turn. Its memory
/// is reused.
class CyclicEdgeCounter {
public:
    /// The number of such edges in `graph` restricted to the polygons `among`, without edges into or out of `removed`,
    /// and without those by which a polygon of `occluders` hides one of `occluded`.
    std::size_t count(const OcclusionGraph& graph, std::span<const std::uint32_t> among, const PolygonSet& occluders,
        const PolygonSet& occluded, const PolygonSet& removed);

    /// For each polygon of `among` the number of its component, after count().
    std::span<const std::uint32_t> component_of() const { return component_; }

private:
    /// A polygon on the stack of the depth-first search, and which of its edges are left.
    struct Visit {
        std::uint32_t polygon = 0;
        std::size_t word = 0;
        std::uint64_t left = 0;
    };

    /// One word of a polygon's row in the restricted graph.
    std::uint64_t row_word(std::uint32_t polygon, std::size_t word) const;
    /// Searches depth first from a polygon.
    void search_from(std::uint32_t root);
    void close(std::uint32_t polygon);

    const OcclusionGraph* graph_ = nullptr;
    const PolygonSet* hiding_ = nullptr;
    const PolygonSet* hidden_ = nullptr;
    std::vector<std::uint64_t> allowed_;
    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> lowlink_;
    std::vector<std::uint32_t> component_;
    std::vector<std::uint64_t> members_;
    std::vector<std::uint64_t> row_;
    std::vector<std::uint32_t> open_;
    std::vector<Visit> visits_;
    std::uint32_t next_number_ = 0;
    std::uint32_t next_component_ = 0;
    std::size_t edges_ = 0;
};

} // namespace octant::visuals::draworder
