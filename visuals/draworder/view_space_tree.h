#pragma once

#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/split_plane_search.h"
#include "visuals/draworder/working_model.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// A tree of planes over a region of eye space, with the lists and planes of its cells. Planes are
/// in the faces' space.
struct ViewSpaceTree {
    std::vector<DrawOrder::Node> nodes; ///< Node 0 is the root; children come after their parents.
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<std::vector<Plane>> cell_planes;
    /// For each cell without a list of its own, where the search was given up, its sets of polygons
    /// (component_sets); empty for others.
    std::vector<std::vector<std::vector<std::uint32_t>>> incomplete_cells;
    std::string incomplete_reason; ///< Why the search was given up first; empty if it was not.
};

/// What a tree costs: fewer splits are better, and of as many fewer cells.
struct TreeCost {
    std::size_t splits = 0;
    std::size_t cells = 0;

    std::strong_ordering operator<=>(const TreeCost&) const = default;
};

/// How thoroughly a tree is searched for.
struct TreeSearch {
    SplitPlaneSearch plane_search = {};
    /// The most cuts one after another.
    std::size_t max_depth = 100;
    /// Whether planes are tried before polygons are split, even where an eye in the middle of a
    /// region sees a ring: more cells, sometimes fewer splits.
    bool prefers_planes = false;
    /// Whether what was found is kept where the search is given up (ViewSpaceTree::open).
    bool keeps_partial_result = false;
    /// The search is given up as soon as its tree is sure to cost as much as this; then nothing of
    /// it is kept.
    std::optional<TreeCost> cost_limit = {};
    /// So is it where the tree is sure to have more splits. Asked once a polygon is split; may be
    /// empty.
    std::function<int()> max_splits = {};
};

/// A tree over a node's region whose cells have no cycles. Splits polygons of the model where there
/// is no order otherwise. Throws SearchGivenUp (search_budget.h) when it grows beyond what can be
/// held, or when a budget is spent; where part of it is kept, only if there is none.
ViewSpaceTree view_space_tree(WorkingModel& work, const ViewCell& root, const TreeSearch& search);

} // namespace octant::visuals::draworder
