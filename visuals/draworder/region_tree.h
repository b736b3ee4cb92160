#pragma once

#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/eye_node.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::draworder {

/// A tree of planes over a region of eye space, the lists and planes of its cells. Planes are in
/// the faces' space.
struct RegionTree {
    std::vector<DrawOrder::Node> nodes; ///< node 0 first, children behind their parents
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<std::vector<Plane>> cell_planes;
};

/// How a tree is looked for.
struct TreeSearch {
    double power = 1.0;              ///< a graph with E cyclic edges is taken to cost E^power
    std::size_t exact = 16;          ///< planes of which both sides are tested exactly
    std::vector<std::size_t> widths; ///< how many planes are followed up at depth 0, 1, ...; then 1
};

/// A tree whose cells have no cycles, or why there is none.
struct TreeResult {
    RegionTree tree;
    std::optional<Deadlock> deadlock; ///< then the tree is empty
};

/// A tree over a node's region. Throws Error when it grows beyond what can be held.
TreeResult region_tree(RegionGraphs& graphs, const EyeNode& root, const TreeSearch& search);

} // namespace octant::visuals::draworder
