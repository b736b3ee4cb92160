#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::refine {

/// What must be there before a node may split.
enum class SplitRule {
    Selective, ///< Kim & Lee 2000: two different cut vertices
    Hoppe,     ///< Hoppe 1997: the faces that lay beside the two new ones when they collapsed
    Xia        ///< Xia & Varshney 1996: all vertices that lay around when it collapsed
};

/// What the two earlier rules remember of each collapse, for comparison: found by collapsing the
/// whole mesh in its order once.
class EarlierRules {
public:
    explicit EarlierRules(const ProgressiveMesh& mesh);

    /// Original faces across the other edges of the two faces that the collapse took away: fn0 to
    /// fn3 of Hoppe 1997; none on a boundary.
    const std::array<std::uint32_t, 4>& faces_beside(std::uint32_t node) const {
        return faces_beside_[node - leaves_];
    }

    /// The nodes around both children when they collapsed.
    std::span<const std::uint32_t> ring(std::uint32_t node) const { return rings_[node - leaves_]; }

    /// The node whose split brings an original face in; none for faces of the base mesh.
    std::uint32_t introducer(std::uint32_t face) const { return introducers_[face]; }

private:
    std::uint32_t leaves_;
    std::vector<std::array<std::uint32_t, 4>> faces_beside_;
    std::vector<std::vector<std::uint32_t>> rings_;
    std::vector<std::uint32_t> introducers_;
};

} // namespace octant::visuals::refine
