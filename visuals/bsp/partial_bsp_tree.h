#pragma once

#include "visuals/bsp/polygon_pieces.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace octant::visuals::bsp {

/// An order for every eye by dividing the polygons themselves: a BSP tree whose leaves are lists
/// that are right for every eye, however large, and in which parts that hide one another in one
/// direction only are painted one after the other without being parted.
struct PartialBspTree {
    static constexpr int nothing = std::numeric_limits<int>::min();

    /// A child >= 0 is a later node, one < 0 is the list ~child or `nothing`.
    struct Node {
        /// Nothing: `front` is painted, then `back`. Else what is on the other side of the plane
        /// than the eye is painted first, then what lies in it and faces the eye.
        std::optional<Plane> plane; ///< In the unit of Pieces.
        int front = nothing;
        int back = nothing;
        int coplanar_front = nothing;   ///< What lies in the plane and faces as it does.
        int coplanar_back = nothing; ///< What lies in the plane and faces back.
    };

    int root = nothing;
    std::vector<Node> nodes;
    std::vector<std::vector<std::uint32_t>> lists; ///< Pieces, first painted first.
    /// Rings of pieces that turn, or turn and meet others, and that no plane parts.
    std::vector<std::vector<std::uint32_t>> unsplit_cycles;
    int depth = 0; ///< The number of nodes on the longest path from the root.
};

/// Orders pieces, cutting them where they must be. The same pieces give the same tree. Without
/// `has_list_leaves` every set of two or more is divided by a plane, as in a BSP tree.
PartialBspTree partial_bsp_tree(PolygonPieces& pieces, std::vector<std::uint32_t> items, bool has_list_leaves = true);

} // namespace octant::visuals::bsp
