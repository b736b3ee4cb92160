#pragma once

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

} // namespace octant::visuals::draworder
