#pragma once

#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/eye_node.h"
#include "visuals/draworder/working_model.h"

#include <cstdint>
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
    double power = 1.0;             ///< a graph with E cyclic edges is taken to cost E^power
    std::size_t edge_planes = 8000; ///< about how many planes through an edge and a corner to try
    std::size_t closer = 400;       ///< planes of which the rings left on both sides are counted
    std::size_t exact = 48;         ///< planes of which both sides are tested exactly
    std::size_t most_depth = 100;   ///< cuts one behind another; more is an Error
};

/// A tree over a node's region whose cells have no cycles. Splits polygons of the model where there
/// would be no order. Throws Error when it grows beyond what can be held.
RegionTree region_tree(WorkingModel& work, const EyeNode& root, const TreeSearch& search);

} // namespace octant::visuals::draworder
