#pragma once

#include "visuals/bsp/polygon_pieces.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::bsp {

/// Whether one piece hides part of another for some eye anywhere. It does exactly when it reaches before the plane of
/// the other one, and that one reaches behind the plane of the first. Proof: let b be a point of `occluder` before
/// plane(occluded), and a a point of `occluded` behind plane(occluder). An eye on the line from a through b, a little
/// beyond b, is before both planes and sees b in front of a. A body has no plane, so that no side rules it out. Pieces
/// of one pivot keep their places to one another (PolygonPieces::add_rigid).
///
/// Pieces in one plane that face alike and overlap hide one another by a rule: the later polygon of the file is painted
/// over the earlier one, as a decal.
bool occludes(const PolygonPieces& pieces, std::uint32_t occluder, std::uint32_t occluded);

/// Divides pieces into the strongly connected components of the graph of what hides what for eyes anywhere (R. Tarjan,
/// "Depth-first search and linear graph algorithms", 1972), in painting order: painted one after the other they are
/// right for every eye. Components of several pieces, which hide one another in a cycle, are ascending. The time grows
/// with the square of the number of items.
std::vector<std::vector<std::uint32_t>> occlusion_components(
    const PolygonPieces& pieces, std::span<const std::uint32_t> items);

/// An order for every eye by dividing the polygons themselves: a BSP tree whose leaves are lists that are right for
/// every eye, however large, and in which parts that hide one another in one direction only are painted one after the
/// other without being parted.
struct PartialBspTree {
    static constexpr int no_child = std::numeric_limits<int>::min();

    /// A child >= 0 is a later node, one < 0 is the list ~child or no_child.
    struct Node {
        /// Nothing: `front` is painted, then `back`. Else what is on the other side of the plane than the eye is
        /// painted first, then what lies in it and faces the eye.
        std::optional<Plane> plane; ///< In the unit of PolygonPieces.
        int front = no_child;
        int back = no_child;
        int coplanar_front = no_child; ///< What lies in the plane and faces as it does.
        int coplanar_back = no_child;  ///< What lies in the plane and faces back.
    };

    int root = no_child;
    std::vector<Node> nodes;
    std::vector<std::vector<std::uint32_t>> lists; ///< Pieces, first painted first.
    /// Cycles of pieces, some of which turn, that no plane separates.
    std::vector<std::vector<std::uint32_t>> unsplit_cycles;
    int depth = 0; ///< The number of nodes on the longest path from the root.
};

/// Orders pieces, cutting them where they must be. The same pieces give the same tree.
PartialBspTree partial_bsp_tree(PolygonPieces& pieces, std::vector<std::uint32_t> items);

} // namespace octant::visuals::bsp
