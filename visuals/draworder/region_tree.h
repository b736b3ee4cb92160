#pragma once

#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/eye_node.h"
#include "visuals/draworder/working_model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// A tree of planes over a region of eye space, with the lists and planes of its cells. Planes are
/// in the faces' space.
struct RegionTree {
    std::vector<DrawOrder::Node> nodes; ///< Node 0 is the root; children come after their parents.
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<std::vector<Plane>> cell_planes;
    /// For each cell without a list of its own, where the search was given up, its sets of polygons
    /// (clusters_of); empty for others.
    std::vector<std::vector<std::vector<std::uint32_t>>> open;
    std::string why_open; ///< Why the search was given up first; empty if it was not.
};

/// How thoroughly a tree is searched for.
struct TreeSearch {
    double power = 1.0; ///< A graph with E cyclic edges is taken to cost E^power.
    /// About how many planes through an edge and a corner are tried.
    std::size_t edge_planes = 8000;
    std::size_t closer = 400;     ///< For so many planes the edges left on cycles are counted.
    std::size_t exact = 48;       ///< For so many planes both sides are tested exactly.
    std::size_t most_depth = 100; ///< The most cuts one after another.
    /// Whether planes are tried before polygons are split, even where an eye in the middle of a
    /// region sees a ring: more cells, sometimes fewer splits.
    bool planes_first = false;
    /// Whether what was found is kept where the search is given up (RegionTree::open).
    bool keeps_part = false;
    /// Whether planes across the axes are tried first. A model that is turned then gets others.
    bool by_axes = false;
};

/// A tree over a node's region whose cells have no cycles. Splits polygons of the model where there
/// is no order otherwise. Throws SearchGivenUp (search_budget.h) when it grows beyond what can be
/// held, or when a budget is spent; where part of it is kept, only if there is none.
RegionTree region_tree(WorkingModel& work, const EyeNode& root, const TreeSearch& search);

} // namespace octant::visuals::draworder
