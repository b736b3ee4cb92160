#pragma once

#include "visuals/verify/pair_check.h"

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace octant::visuals::verify {

/// Checks that each polygon is painted where it can be seen, once, and over those of its own plane
/// that it is to cover. Throws Refusal. Keeps references.
class PaintedCheck {
public:
    PaintedCheck(const Certificate& certificate, const ExactSides& sides, const PairCheck& pair_check);

    /// That in a child nothing is painted but what is expected, and that what is expected and not
    /// painted faces away from all eyes before the walls. Returns how many do.
    std::uint64_t require_painted(
        int child,
        std::span<const std::uint32_t> expected,
        std::span<const std::uint32_t> painted,
        const RegionPlanes& region_planes);

    /// That no polygon lies in two parts of a node, front, back, along and against, but for flat
    /// ones in its plane that are seen from both sides.
    void require_disjoint(int line, const std::array<std::span<const std::uint32_t>, 4>& parts);

    /// That in a list what overlaps in one plane is painted as the model's file has it.
    void require_layer_order(std::span<const std::uint32_t> list, int line) const;

    /// The same for all of one part painted before all of another.
    void require_layer_order(
        std::span<const std::uint32_t> first, std::span<const std::uint32_t> later, int line) const;

private:
    const Certificate& certificate_;
    const PairCheck& pair_check_;
    std::vector<PolygonPair> coplanar_layer_pairs_;
    std::vector<char> mark_; ///< One for each polygon; all are 0 between checks.
};

} // namespace octant::visuals::verify
