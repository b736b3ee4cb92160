#pragma once

#include "visuals/draworder/hiding_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// The part of a hiding graph that has cycles: its strongly connected components of two or more
/// polygons, without the edges between them.
struct Cycles {
    std::vector<std::uint32_t> polygons;                ///< of all components, in rising order
    std::vector<std::vector<std::uint32_t>> components; ///< each in rising order
    HidingGraph inner;                                  ///< edges within a component
    std::size_t edges = 0;                              ///< how many these are
};

/// R. Tarjan, "Depth-first search and linear graph algorithms", 1972. Looks at the given polygons
/// only, and at the edges between them.
Cycles cycles_of(const HidingGraph& graph, std::span<const std::uint32_t> among);

/// The same for all polygons.
Cycles cycles_of(const HidingGraph& graph);

/// A ring with the fewest polygons: each hidden by the next, the last by the first. Empty without
/// cycles. Looks for it from the given polygons.
std::vector<std::uint32_t>
shortest_ring(const HidingGraph& graph, std::span<const std::uint32_t> among);

/// How many edges lie on cycles of `graph` without those that go into or out of `gone`, and without
/// those by which one of `hiding` hides one of `hidden`. Looks at the given polygons only. Reuses
/// its storage.
class CyclicEdges {
public:
    std::size_t count(
        const HidingGraph& graph,
        std::span<const std::uint32_t> among,
        const PolygonSet& hiding,
        const PolygonSet& hidden,
        const PolygonSet& gone);

    /// Component of each polygon after count(); of `among` only.
    std::span<const std::uint32_t> component_of() const { return component_; }

private:
    struct Visit {
        std::uint32_t polygon = 0;
        std::size_t word = 0;
        std::uint64_t left = 0;
    };

    std::uint64_t row_word(std::uint32_t polygon, std::size_t word) const;
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
