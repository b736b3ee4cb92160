#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// `first` has to be painted before `later`.
struct Precedence {
    std::uint32_t first = 0;
    std::uint32_t later = 0;
};

struct PaintSequence {
    std::vector<std::uint32_t> order; ///< first painted first
    int broken_cycles = 0;            ///< how often a polygon came before one it should follow
};

/// An order of 0 .. count - 1 that keeps all precedences (each between two of them, asserted), the
/// lowest number first wherever they leave a choice. In a cycle the polygon that waits for the
/// fewest others goes ahead, the lowest number among equals; each such step counts once.
PaintSequence paint_sequence(std::size_t count, std::span<const Precedence> precedences);

} // namespace octant::visuals::draworder
