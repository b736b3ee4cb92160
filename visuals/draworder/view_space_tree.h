#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/search_budget.h"
#include "visuals/draworder/view_cell.h"

#include <glm/vec3.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// Where polygons lie to a plane that cuts a region of eyes, and for each side of it those polygons that lie in the
/// plane and face away from all eyes there.
struct PolygonsByPlaneSide {
    explicit PolygonsByPlaneSide(std::size_t count)
        : sets{BitSet(count), BitSet(count)}, back_facing_in_front(count), back_facing_behind(count) {}

    PlaneSideSets sets;
    BitSet back_facing_in_front;
    BitSet back_facing_behind;
};

/// Where the polygons `among` lie to a plane.
PolygonsByPlaneSide sides_of(const Plane& plane, const ModelFaces& model, std::span<const std::uint32_t> among);

/// How thoroughly a plane is searched for.
struct SplitPlaneSearch {
    /// A graph with E cyclic edges is taken to cost E^power.
    double power = 1.0;
    /// About how many planes through an edge and a corner are tried.
    std::size_t edge_planes = 8000;
    /// For so many planes the edges left on cycles are counted.
    std::size_t coarse_candidates = 400;
    /// For so many planes both sides are tested exactly.
    std::size_t exact = 48;
    /// Further planes of the polygons `among`, about `max` of them, which are tried first; may be empty.
    std::function<std::vector<Plane>(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t max)>
        first_planes = {};
};

/// A tree of planes over a region of eye space, with the lists of its cells. Planes are in the faces' space.
struct ViewSpaceTree {
    std::vector<DrawOrder::Node> nodes; ///< Node 0 is the root; children come after their parents.
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<OrderCell> cells;
    /// For each cell without a list of its own, where the search was given up, its sets of polygons (component_sets);
    /// empty for others.
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
    /// Whether planes are tried before polygons are split, even where an eye in the middle of a region sees a cycle:
    /// more cells, sometimes fewer splits.
    bool prefers_planes = false;
    /// Whether the cells that were found are kept where the search is given up (ViewSpaceTree::incomplete_cells).
    bool keeps_partial_result = false;
    /// The search is given up as soon as its tree is sure to cost as much as this; then nothing of it is kept.
    std::optional<TreeCost> cost_limit = {};
    /// So is it where the tree is sure to have more splits. Asked once a polygon is split; may be empty.
    std::function<int()> max_splits = {};
};

/// A tree over a node's region whose cells have no cycles. Splits polygons of the model where there is no order
/// otherwise. Throws SearchGivenUp (search_budget.h) when it grows beyond what can be held, or when a budget is spent;
/// where part of it is kept, only if there is none.
ViewSpaceTree view_space_tree(WorkingModel& work, const ViewCell& root, const TreeSearch& search);

/// What a search over eye space finds.
struct CellSearchResult {
    WorkingModel work; ///< The model, with the polygons that were split.
    ViewSpaceTree tree;

    TreeCost cost() const { return {work.sibling_pieces.size(), tree.cells.size()}; }
};

/// The best of several trees over all of eye space. Throws SearchGivenUp when no search finds any, or only trees that
/// split polygons more often than `max_splits` says (TreeSearch).
CellSearchResult best_tree(
    const models::polygons::PolygonModel& model, SearchBudget& budget, const std::function<int()>& max_splits = {});

} // namespace octant::visuals::draworder
