// Method::Tree: painting orders for every eye, the model's inside included. Section IV of the 1989
// paper divides the viewing directions until all hidden surfaces are removed; here eye space is
// divided by planes until each cell's hiding graph has no cycle.
//
// The search is greedy: at a node the plane that leaves least of the cycles divides it
// (fork_choice.cpp). Before that, an eye in the middle of the node is looked at: if it already sees
// a ring, no plane can help, and a polygon is split.
#include "visuals/draworder/region_tree.h"

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
    std::vector<std::vector<std::uint32_t>> open; ///< As RegionTree has them.
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

    std::unique_ptr<Branch> grow(EyeNode node, std::size_t depth);

    /// Why the search was given up first; empty if it was not.
    const std::string& why_open() const { return why_open_; }

private:
    std::unique_ptr<Branch> found(EyeNode& node, std::size_t depth);
    std::unique_ptr<Branch> open_leaf(EyeNode& node);
    std::unique_ptr<Branch> leaf(const EyeNode& node);
    std::optional<Fork> settle(EyeNode& node);
    void check_cost() const;

    WorkingModel& work_;
    RegionGraphs graphs_;
    const TreeSearch& search_;
    std::size_t entries_ = 0;
    std::size_t cells_ = 1; ///< Finished ones, and one for each branch that is still to grow.
    std::string why_open_;
};

/// Throws SearchGivenUp where the tree, which only grows, costs too much already.
void TreeBuilder::check_cost() const {
    const TreeCost cost{work_.twins.size(), cells_};
    const bool costs_more = search_.less_than && cost >= *search_.less_than;
    const bool splits_more = cost.splits > 0 && search_.max_splits &&
                             static_cast<int>(cost.splits) > search_.max_splits();
    if (costs_more || splits_more) {
        throw SearchGivenUp{"another order costs less", true};
    }
}

/// The finished cell of a node without cycles.
std::unique_ptr<Branch> TreeBuilder::leaf(const EyeNode& node) {
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
std::optional<Fork> TreeBuilder::settle(EyeNode& node) {
    while (node.cycles.edges > 0) {
        std::optional<Deadlock> deadlock;
        if (!search_.planes_first) {
            deadlock = ring_at_eye(graphs_, node);
        }
        if (!deadlock) {
            if (auto fork = best_fork(work_, node, search_.forks)) {
                return fork;
            }
            deadlock = ring_at_eye(graphs_, node);
        }
        if (!deadlock) {
            deadlock = Deadlock{node.cycles.components.front(), node.region, std::nullopt};
        }
        work_.spend(search_units(node));
        work_.resolve(*deadlock);
        check_cost();
        work_.catch_up(node);
        node = part_of(graphs_, node, node.region);
    }
    return std::nullopt;
}

/// The end of a branch where the search is given up.
std::unique_ptr<Branch> TreeBuilder::open_leaf(EyeNode& node) {
    work_.catch_up(node);
    auto out = std::make_unique<Branch>();
    out->open = clusters_of(graphs_, node);
    out->planes = node.region.planes();
    out->polygons = node.graph.count();
    return out;
}

/// The branch of a node, recursively.
std::unique_ptr<Branch> TreeBuilder::grow(EyeNode node, std::size_t depth) {
    if (!search_.keeps_part) {
        return found(node, depth);
    }
    try {
        return found(node, depth);
    } catch (const SearchGivenUp& given_up) {
        if (given_up.is_beaten) {
            throw;
        }
        why_open_ = why_open_.empty() ? given_up.why : why_open_;
        return open_leaf(node);
    }
}

/// The branch of a node. Throws SearchGivenUp.
std::unique_ptr<Branch> TreeBuilder::found(EyeNode& node, std::size_t depth) {
    check_entries(entries_); // where a list was too much already, another one is, too
    if (depth == search_.max_depth) {
        throw SearchGivenUp{
            fmt::format("{} planes one after another make no cell", search_.max_depth)};
    }
    if (work_.catch_up(node)) {
        node = part_of(graphs_, node, node.region);
    }
    work_.spend(search_units(node));
    std::optional<Fork> fork = settle(node);
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
int flatten(Branch& branch, const WorkingModel& work, RegionTree& out) {
    if (!branch.plane) {
        work.catch_up(branch.list, branch.polygons);
        for (std::vector<std::uint32_t>& set : branch.open) {
            work.catch_up(set, branch.polygons);
        }
        out.lists.push_back(std::move(branch.list));
        out.open.push_back(std::move(branch.open));
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

RegionTree region_tree(WorkingModel& work, const EyeNode& root, const TreeSearch& search) {
    TreeBuilder builder(work, search);
    const auto branch = builder.grow(root, 0);
    if (!branch->plane && !builder.why_open().empty()) {
        throw SearchGivenUp{builder.why_open()};
    }
    RegionTree tree;
    flatten(*branch, work, tree);
    tree.why_open = builder.why_open();
    return tree;
}

} // namespace octant::visuals::draworder
