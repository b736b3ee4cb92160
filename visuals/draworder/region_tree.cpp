// Method::Tree: painting orders for every eye, the model's inside included. Section IV of the 1989
// paper divides the viewing directions until all hidden surfaces are removed; here eye space is
// divided by planes until each cell's hiding graph has no cycle.
//
// The search is greedy. At a node the candidate planes are judged in three stages, each more exact
// and more expensive, and applied to fewer planes: by where polygons lie to the plane (PlaneJudge),
// by the edges that stay on cycles then (CyclicEdges), and by building both sides' graphs with the
// exact hiding test. The plane with the least cost divides the node. Before that, an eye in the
// middle of the node is looked at: if it already sees a ring, no plane can help, and a polygon is
// split.
#include "visuals/draworder/region_tree.h"

#include "visuals/draworder/candidate_planes.h"
#include "visuals/draworder/components.h"
#include "visuals/draworder/parallel.h"
#include "visuals/draworder/plane_judge.h"
#include "visuals/draworder/search_budget.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// Graphs with more edges are judged without the exact test.
constexpr std::size_t most_exact_edges = 4'000;
/// When the first planes lead nowhere, so many times as many are tried.
constexpr std::size_t more_planes = 16;

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

/// A candidate plane with its estimated cost. The number tells equal ones apart.
struct Choice {
    Plane plane;
    double cost = 0.0;
    std::size_t number = 0;

    bool operator<(const Choice& other) const {
        return std::pair(cost, number) < std::pair(other.cost, other.number);
    }
};

/// A node that was divided by a plane.
struct Fork {
    Plane plane;
    EyeNode front;
    EyeNode back;
};

Plane reversed(const Plane& plane) {
    return {-plane.normal, -plane.offset_m};
}

/// Whether a node's work is worth a second thread.
bool is_large(const EyeNode& node) {
    return node.cycles.edges > 500;
}

/// The work of judging a plane by where polygons lie to it.
std::uint64_t units_of_plane(const Cycles& cycles) {
    constexpr std::size_t most_rows = 192;
    std::size_t words = 0;
    for (const auto& component : cycles.components) {
        words += std::min(component.size(), most_rows) * (component.size() / 64 + 1);
    }
    return 15 * cycles.polygons.size() + 4 * words;
}

/// The work of counting the edges that a plane leaves on cycles.
std::uint64_t units_of_rings(const Cycles& cycles) {
    const std::size_t words = cycles.inner.count() / 64 + 1;
    return 2 * (30 + 4 * words) * cycles.polygons.size() + 4 * cycles.edges;
}

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
    std::vector<Choice>
    by_sides(const EyeNode& node, std::span<const Plane> planes, std::size_t first_number) const;
    std::vector<Choice> by_rings(const EyeNode& node, std::span<const Choice> choices) const;
    std::vector<Choice> ranked(const EyeNode& node, std::span<const Plane> planes) const;
    std::optional<Fork> best_fork(const EyeNode& node) const;
    Fork fork(const EyeNode& node, const Plane& plane) const;
    std::optional<Fork> settle(EyeNode& node);
    double cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const;
    double little_gain(std::size_t before) const;

    WorkingModel& work_;
    RegionGraphs graphs_;
    const TreeSearch& search_;
    std::size_t entries_ = 0;
    std::string why_open_;
};

/// The cost of a plane that leaves so many cyclic edges in front and behind, of `before`; less is
/// better. A side that stays as it was is no gain at all and costs infinitely much.
double
TreeBuilder::cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const {
    if (front_edges >= before || back_edges >= before) {
        return HUGE_VAL;
    }
    return std::pow(static_cast<double>(front_edges), search_.power) +
           std::pow(static_cast<double>(back_edges), search_.power);
}

/// The cost of a plane that leaves 15 of 16 edges on both sides.
double TreeBuilder::little_gain(std::size_t before) const {
    const std::size_t left = before - before / 16;
    return cost(left, left, before + 1);
}

/// First stage: the best planes by where polygons lie to them. `first_number` is the number of the
/// first plane.
std::vector<Choice> TreeBuilder::by_sides(
    const EyeNode& node, std::span<const Plane> planes, std::size_t first_number) const {
    const Cycles& cycles = node.cycles;
    PlaneJudge judge(work_.faces, cycles);
    std::vector<Choice> best;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const Plane& plane = planes[i];
        if (!node.region.reaches_front_of(plane) ||
            !node.region.reaches_front_of(reversed(plane))) {
            continue;
        }
        const double limit = best.size() == search_.closer ? best.back().cost : HUGE_VAL;
        judge.look_at(plane);
        const std::size_t front_edges = judge.left_in_front();
        if (cost(front_edges, 0, cycles.edges) >= limit) {
            continue;
        }
        const double value = cost(front_edges, judge.left_behind(), cycles.edges);
        if (value >= limit) {
            continue;
        }
        const Choice choice{plane, value, first_number + i};
        best.insert(std::upper_bound(best.begin(), best.end(), choice), choice);
        if (best.size() > search_.closer) {
            best.pop_back();
        }
    }
    return best;
}

/// Second stage: the cost of each choice by the edges that stay on cycles.
std::vector<Choice>
TreeBuilder::by_rings(const EyeNode& node, std::span<const Choice> choices) const {
    const Cycles& cycles = node.cycles;
    CyclicEdges rings;
    std::vector<Choice> out(choices.begin(), choices.end());
    for (Choice& choice : out) {
        const PlaneSides sides = sides_of(choice.plane, work_.faces, cycles.polygons);
        const auto& [front, back] = sides.sets;
        const auto front_edges =
            rings.count(cycles.inner, cycles.polygons, back, front, sides.unseen_in_front);
        const auto back_edges =
            rings.count(cycles.inner, cycles.polygons, front, back, sides.unseen_behind);
        choice.cost = cost(front_edges, back_edges, cycles.edges);
    }
    return out;
}

/// Both stages over many planes, on two threads; best first.
std::vector<Choice> TreeBuilder::ranked(const EyeNode& node, std::span<const Plane> planes) const {
    work_.spend(planes.size() * units_of_plane(node.cycles));
    const bool large = is_large(node);
    const std::size_t half = planes.size() / 2;
    auto [choices, others] = both(
        large,
        [&] { return by_sides(node, planes.first(half), 0); },
        [&] { return by_sides(node, planes.subspan(half), half); });
    choices.insert(choices.end(), others.begin(), others.end());
    std::sort(choices.begin(), choices.end());
    choices.resize(std::min(search_.closer, choices.size()));
    work_.spend(choices.size() * units_of_rings(node.cycles));
    const std::size_t middle = choices.size() / 2;
    const std::span<const Choice> all(choices);
    auto [judged, rest] = both(
        large,
        [&] { return by_rings(node, all.first(middle)); },
        [&] { return by_rings(node, all.subspan(middle)); });
    judged.insert(judged.end(), rest.begin(), rest.end());
    std::sort(judged.begin(), judged.end());
    return judged;
}

/// Divides a node by a plane, with the exact test on both sides.
Fork TreeBuilder::fork(const EyeNode& node, const Plane& plane) const {
    const SideSets sides = sides_of(plane, work_.faces, node.cycles.polygons).sets;
    const SideSets turned{sides.back_or_on, sides.front_or_on};
    const auto part = [&](const Plane& before, const SideSets& sets) {
        RegionGraphs graphs(work_.faces);
        return part_of(graphs, node, *node.region.cut(before), &sets);
    };
    auto [front, back] = both(
        is_large(node),
        [&] { return part(plane, sides); },
        [&] { return part(reversed(plane), turned); });
    return {plane, std::move(front), std::move(back)};
}

/// Third stage: divides the node by each of the best choices and keeps the best result; for very
/// large graphs only the first choice. Returns nothing when no plane makes the node simpler.
std::optional<Fork> TreeBuilder::best_fork(const EyeNode& node) const {
    const Cycles& cycles = node.cycles;
    const auto of_planes = [&](std::span<const std::uint32_t> among, std::size_t most) {
        std::vector<Plane> planes;
        if (search_.by_axes) {
            planes = axis_planes(work_.faces, among, 2 * most);
        }
        const auto others = candidate_planes(work_.faces, among, most);
        planes.insert(planes.end(), others.begin(), others.end());
        return ranked(node, planes);
    };
    std::vector<Choice> choices = of_planes(cycles.polygons, search_.edge_planes);
    if (choices.empty() || choices.front().cost > little_gain(cycles.edges)) {
        choices = of_planes(cycles.polygons, more_planes * search_.edge_planes);
    }
    if (choices.empty()) {
        // Of many polygons not all candidate planes were made. All those of one ring are enough to
        // resolve it in the end.
        choices = of_planes(shortest_ring(cycles.inner, cycles.polygons), search_.edge_planes);
    }
    const std::size_t tried = cycles.edges > most_exact_edges ? 1 : search_.exact;
    choices.resize(std::min(tried, choices.size()));
    work_.spend(2 * choices.size() * search_units(node));
    std::optional<Fork> best;
    Choice least{.plane = {}, .cost = HUGE_VAL, .number = choices.size()};
    for (const Choice& choice : choices) {
        Fork made = fork(node, choice.plane);
        const double left = cost(made.front.cycles.edges, made.back.cycles.edges, cycles.edges);
        if (const Choice exact{choice.plane, left, choice.number}; !best || exact < least) {
            least = exact;
            best = std::move(made);
        }
    }
    return best;
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
            if (auto fork = best_fork(node)) {
                return fork;
            }
            deadlock = ring_at_eye(graphs_, node);
        }
        if (!deadlock) {
            deadlock = Deadlock{node.cycles.components.front(), node.region, std::nullopt};
        }
        work_.spend(search_units(node));
        work_.resolve(*deadlock);
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
        why_open_ = why_open_.empty() ? given_up.why : why_open_;
        return open_leaf(node);
    }
}

/// The branch of a node. Throws SearchGivenUp.
std::unique_ptr<Branch> TreeBuilder::found(EyeNode& node, std::size_t depth) {
    if (depth == search_.most_depth) {
        throw SearchGivenUp{
            fmt::format("{} planes one after another make no cell", search_.most_depth)};
    }
    if (work_.catch_up(node)) {
        node = part_of(graphs_, node, node.region);
    }
    work_.spend(search_units(node));
    std::optional<Fork> fork = settle(node);
    if (!fork) {
        return leaf(node);
    }
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
