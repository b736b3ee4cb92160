// Method::Tree: painting orders for every eye, the model's inside included. Section IV of the 1989
// paper divides the viewing directions until all hidden surfaces are removed; here eye space is
// divided by planes until each cell's hiding graph has no cycle.
//
// The search is greedy: at a node the plane that leaves least of the cycles divides it
// (fork_choice.cpp). Before that, an eye in the middle of the node is looked at: if it already sees
// a ring, no plane can help, and a polygon is split.
#include "visuals/draworder/view_space_tree.h"

#include "visuals/draworder/search_budget.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// A branch of the tree while it grows: a finished cell, or a plane with two branches.
struct Branch {
    std::optional<Plane> plane;
    std::unique_ptr<Branch> front;
    std::unique_ptr<Branch> back;
    std::vector<std::uint32_t> list;
    std::vector<std::vector<std::uint32_t>> incomplete_cells; ///< As ViewSpaceTree has them.
    std::vector<Plane> planes;
    std::size_t polygons = 0; ///< The number of polygons when the list was made.
};

/// Builds one tree.
class TreeBuilder {
public:
    TreeBuilder(WorkingModel& work, const TreeSearch& search)
        : work_(work)
        , graphs_(work.faces)
        , search_(search) {}

    std::unique_ptr<Branch> grow(ViewCell node, std::size_t depth);

    /// Why the search was given up first; empty if it was not.
    const std::string& incomplete_reason() const { return why_open_; }

private:
    std::unique_ptr<Branch> found(ViewCell& node, std::size_t depth);
    std::unique_ptr<Branch> open_leaf(ViewCell& node);
    std::unique_ptr<Branch> leaf(const ViewCell& node);
    std::optional<CellSplit> settle(ViewCell& node);
    void check_cost() const;

    WorkingModel& work_;
    OcclusionGraphBuilder graphs_;
    const TreeSearch& search_;
    std::size_t entries_ = 0;
    std::size_t cells_ = 1; ///< Finished ones, and one for each branch that is still to grow.
    std::string why_open_;
};

/// Throws SearchGivenUp where the tree, which only grows, costs too much already.
void TreeBuilder::check_cost() const {
    const TreeCost cost{work_.sibling_pieces.size(), cells_};
    const bool costs_more = search_.cost_limit && cost >= *search_.cost_limit;
    const bool splits_more = cost.splits > 0 && search_.max_splits &&
                             static_cast<int>(cost.splits) > search_.max_splits();
    if (costs_more || splits_more) {
        throw SearchGivenUp{"another order costs less", true};
    }
}

/// The finished cell of a node without cycles.
std::unique_ptr<Branch> TreeBuilder::leaf(const ViewCell& node) {
    auto out = std::make_unique<Branch>();
    out->list = list_of(graphs_, node);
    out->planes = node.region.planes();
    out->polygons = node.graph.count();
    entries_ += out->list.size();
    check_entries(entries_);
    return out;
}

/// Splits polygons until an eye in the middle of the node sees no ring and some plane makes the
/// node simpler, and returns the node divided by that plane. Returns nothing once the node has no
/// cycles.
std::optional<CellSplit> TreeBuilder::settle(ViewCell& node) {
    while (node.cycles.edges > 0) {
        std::optional<PersistentCycle> persistent_cycle;
        if (!search_.prefers_planes) {
            persistent_cycle = cycle_at_eye(graphs_, node);
        }
        if (!persistent_cycle) {
            if (auto fork = best_split(work_, node, search_.plane_search)) {
                return fork;
            }
            persistent_cycle = cycle_at_eye(graphs_, node);
        }
        if (!persistent_cycle) {
            persistent_cycle = PersistentCycle{node.cycles.components.front(), node.region, std::nullopt};
        }
        work_.spend(search_units(node));
        work_.resolve(*persistent_cycle);
        check_cost();
        work_.add_new_pieces(node);
        node = part_of(graphs_, node, node.region);
    }
    return std::nullopt;
}

/// The end of a branch where the search is given up.
std::unique_ptr<Branch> TreeBuilder::open_leaf(ViewCell& node) {
    work_.add_new_pieces(node);
    auto out = std::make_unique<Branch>();
    out->incomplete_cells = component_sets(graphs_, node);
    out->planes = node.region.planes();
    out->polygons = node.graph.count();
    return out;
}

/// The branch of a node, recursively.
std::unique_ptr<Branch> TreeBuilder::grow(ViewCell node, std::size_t depth) {
    if (!search_.keeps_partial_result) {
        return found(node, depth);
    }
    try {
        return found(node, depth);
    } catch (const SearchGivenUp& given_up) {
        if (given_up.is_worse_than_best) {
            throw;
        }
        why_open_ = why_open_.empty() ? given_up.reason : why_open_;
        return open_leaf(node);
    }
}

/// The branch of a node. Throws SearchGivenUp.
std::unique_ptr<Branch> TreeBuilder::found(ViewCell& node, std::size_t depth) {
    check_entries(entries_); // where a list was too much already, another one is, too
    if (depth == search_.max_depth) {
        throw SearchGivenUp{
            fmt::format("{} planes one after another make no cell", search_.max_depth)};
    }
    if (work_.add_new_pieces(node)) {
        node = part_of(graphs_, node, node.region);
    }
    work_.spend(search_units(node));
    std::optional<CellSplit> fork = settle(node);
    if (!fork) {
        return leaf(node);
    }
    ++cells_;
    check_cost();
    auto out = std::make_unique<Branch>();
    out->plane = fork->plane;
    out->front = grow(std::move(fork->front), depth + 1);
    out->back = grow(std::move(fork->back), depth + 1);
    return out;
}

/// Appends a branch to the arrays of the tree and returns its number as a child.
int flatten(Branch& branch, const WorkingModel& work, ViewSpaceTree& out) {
    if (!branch.plane) {
        work.add_new_pieces(branch.list, branch.polygons);
        for (std::vector<std::uint32_t>& set : branch.incomplete_cells) {
            work.add_new_pieces(set, branch.polygons);
        }
        out.lists.push_back(std::move(branch.list));
        out.incomplete_cells.push_back(std::move(branch.incomplete_cells));
        out.cell_planes.push_back(std::move(branch.planes));
        return ~static_cast<int>(out.lists.size() - 1);
    }
    const std::size_t at = out.nodes.size();
    out.nodes.push_back({*branch.plane, 0, 0});
    const int front = flatten(*branch.front, work, out);
    const int back = flatten(*branch.back, work, out);
    out.nodes[at].front = front;
    out.nodes[at].back = back;
    return static_cast<int>(at);
}

} // namespace

ViewSpaceTree view_space_tree(WorkingModel& work, const ViewCell& root, const TreeSearch& search) {
    TreeBuilder builder(work, search);
    const auto branch = builder.grow(root, 0);
    if (!branch->plane && !builder.incomplete_reason().empty()) {
        throw SearchGivenUp{builder.incomplete_reason()};
    }
    ViewSpaceTree tree;
    flatten(*branch, work, tree);
    tree.incomplete_reason = builder.incomplete_reason();
    return tree;
}

} // namespace octant::visuals::draworder
