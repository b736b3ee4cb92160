#pragma once

#include "sim/base/bit_set.h"
#include "visuals/bsp/component_search.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Polygon `first` must be painted before polygon `later`.
struct Precedence {
    std::uint32_t first = 0;
    std::uint32_t later = 0;
};

/// A painting order that was made from precedences.
struct TopologicalOrder {
    std::vector<std::uint32_t> order; ///< First painted first.
    int broken_cycles = 0;            ///< How often a polygon came before one that it should follow.
};

/// Sorts 0 to count - 1 topologically: an order that keeps all precedences (each between two of these numbers,
/// asserted), with the lowest number first wherever there is a choice. In a cycle the polygon that waits for the fewest
/// others goes ahead, the lowest number among equals; each such step counts as a broken cycle.
TopologicalOrder topological_order(std::size_t count, std::span<const Precedence> precedences);

/// Which polygons hide parts of which others for the eyes of some region, as a square matrix of bits. Row a holds the
/// polygons that hide part of a; they must be painted after it.
class OcclusionGraph {
public:
    explicit OcclusionGraph(std::size_t count) : count_(count), bits_(count, count) {}

    std::size_t count() const { return count_; }

    /// Whether b hides part of a.
    bool occludes(std::size_t b, std::size_t a) const { return bits_.has(a, b); }

    void add(std::size_t b, std::size_t a) { bits_.add(a, b); }

    void remove(std::size_t b, std::size_t a) { bits_.remove(a, b); }

    /// The polygons that hide part of a, one bit each.
    std::span<const std::uint64_t> row(std::size_t a) const { return bits_.row(a); }

    std::span<std::uint64_t> row(std::size_t a) { return bits_.row(a); }

    /// Adds a polygon with the same edges as another one: the second piece of a split polygon.
    void add_sibling(std::size_t polygon);

    /// All edges between polygons of a set, as precedences.
    std::vector<Precedence> precedences(const BitSet& among) const;

private:
    std::size_t count_;
    BitMatrix bits_;
};

/// The cyclic part of an occlusion graph: its strongly connected components of two or more polygons, and the edges
/// within them.
struct CyclicPart {
    std::vector<std::uint32_t> polygons; ///< The polygons of all components, ascending.
    /// The polygons of each component, ascending.
    std::vector<std::vector<std::uint32_t>> components;
    OcclusionGraph inner;  ///< The edges within components.
    std::size_t edges = 0; ///< The number of these edges.
};

/// The cyclic part of the polygons `among` and the edges between them.
CyclicPart cyclic_part_of(const OcclusionGraph& graph, std::span<const std::uint32_t> among);

/// The cyclic part among all polygons.
CyclicPart cyclic_part_of(const OcclusionGraph& graph);

/// A cycle with the fewest polygons: each is hidden by the next, and the last by the first. Empty when there is no
/// cycle. The search starts from the polygons `among`.
std::vector<std::uint32_t> shortest_cycle(const OcclusionGraph& graph, std::span<const std::uint32_t> among);

/// Counts the edges within strongly connected components, for many variants of one graph in turn. Reuses its memory.
class CyclicEdgeCounter {
public:
    /// The number of such edges in `graph` restricted to the polygons `among`, without edges into or out of `removed`,
    /// and without those by which a polygon of `occluders` hides one of `occluded`.
    std::size_t count(const OcclusionGraph& graph, std::span<const std::uint32_t> among, const BitSet& occluders,
        const BitSet& occluded, const BitSet& removed);

private:
    bsp::ComponentSearch search_;
    BitSet allowed_;
    BitSet members_;
    std::vector<std::uint64_t> row_;
};

} // namespace octant::visuals::draworder
