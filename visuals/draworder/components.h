#pragma once

#include "visuals/draworder/hiding_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// The cyclic part of a hiding graph: its strongly connected components of two or more polygons,
/// and the edges within them.
struct Cycles {
    std::vector<std::uint32_t> polygons; ///< The polygons of all components, ascending.
    /// The polygons of each component, ascending.
    std::vector<std::vector<std::uint32_t>> components;
    HidingGraph inner;     ///< The edges within components.
    std::size_t edges = 0; ///< The number of these edges.
};

/// Finds the cyclic part by R. Tarjan, "Depth-first search and linear graph algorithms", 1972. Only
/// the polygons `among` and the edges between them are looked at.
Cycles cycles_of(const HidingGraph& graph, std::span<const std::uint32_t> among);

/// The cyclic part among all polygons.
Cycles cycles_of(const HidingGraph& graph);

/// A cycle with the fewest polygons ("ring"): each is hidden by the next, and the last by the
/// first. Empty when there is no cycle. The search starts from the polygons `among`.
std::vector<std::uint32_t>
shortest_ring(const HidingGraph& graph, std::span<const std::uint32_t> among);

/// Counts the edges that lie within strongly connected components, for many variants of one graph
/// in turn. Its memory is reused.
class CyclicEdges {
public:
    /// The number of such edges in `graph` restricted to the polygons `among`, without edges into
    /// or out of `gone`, and without those by which a polygon of `hiding` hides one of `hidden`.
    std::size_t count(
        const HidingGraph& graph,
        std::span<const std::uint32_t> among,
        const PolygonSet& hiding,
        const PolygonSet& hidden,
        const PolygonSet& gone);

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

    const HidingGraph* graph_ = nullptr;
    const PolygonSet* hiding_ = nullptr;
    const PolygonSet* hidden_ = nullptr;
    std::vector<std::uint64_t> allowed_;
    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> low_;
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
