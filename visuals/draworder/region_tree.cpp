#include "visuals/draworder/region_tree.h"

#include "sim/base/error.h"
#include "visuals/draworder/candidate_planes.h"
#include "visuals/draworder/components.h"
#include "visuals/draworder/plane_judge.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// Graphs with more edges are judged by sides alone.
constexpr std::size_t most_exact_edges = 4'000;
constexpr std::size_t most_depth = 100;

/// A cell to be, or a cut.
struct Branch {
    std::optional<Plane> plane;
    std::unique_ptr<Branch> front;
    std::unique_ptr<Branch> back;
    std::vector<std::uint32_t> list;
    std::vector<Plane> planes;
    std::size_t polygons = 0; ///< when the list was made
};

struct Choice {
    Plane plane;
    double cost = 0.0;
    std::size_t number = 0;

    bool operator<(const Choice& other) const {
        return std::pair(cost, number) < std::pair(other.cost, other.number);
    }
};

/// A node cut in two.
struct Fork {
    Plane plane;
    EyeNode front;
    EyeNode back;
};

Plane reversed(const Plane& plane) {
    return {-plane.normal, -plane.offset_m};
}

class TreeBuilder {
public:
    TreeBuilder(WorkingModel& work, const TreeSearch& search)
        : work_(work)
        , graphs_(work.faces)
        , search_(search) {}

    std::unique_ptr<Branch> grow(EyeNode node, std::size_t depth);

private:
    std::unique_ptr<Branch> leaf(const EyeNode& node);
    std::vector<Choice> by_sides(const EyeNode& node, const std::vector<Plane>& planes);
    void count_cyclic(const Cycles& cycles, std::vector<Choice>& choices);
    std::optional<Fork> best_fork(const EyeNode& node);
    Fork fork(const EyeNode& node, const Plane& plane);
    std::optional<Fork> settle(EyeNode& node);
    double cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const;

    WorkingModel& work_;
    RegionGraphs graphs_;
    const TreeSearch& search_;
    CyclicEdges cyclic_;
    std::size_t entries_ = 0;
};

/// Lower is better. A side that stays as it was is no gain, and infinitely bad.
double
TreeBuilder::cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const {
    if (front_edges >= before || back_edges >= before) {
        return HUGE_VAL;
    }
    return std::pow(static_cast<double>(front_edges), search_.power) +
           std::pow(static_cast<double>(back_edges), search_.power);
}

/// The planes that leave least on both sides, as judged by sides and then by what stays on rings.
std::vector<Choice> TreeBuilder::by_sides(const EyeNode& node, const std::vector<Plane>& planes) {
    const Cycles& cycles = node.cycles;
    PlaneJudge judge(graphs_.model(), cycles);
    std::vector<Choice> best;
    std::size_t number = 0;
    for (const Plane& plane : planes) {
        ++number;
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
        const Choice choice{plane, value, number};
        best.insert(std::upper_bound(best.begin(), best.end(), choice), choice);
        if (best.size() > search_.closer) {
            best.pop_back();
        }
    }
    count_cyclic(cycles, best);
    return best;
}

/// Judges choices by what stays on rings, and sorts them.
void TreeBuilder::count_cyclic(const Cycles& cycles, std::vector<Choice>& choices) {
    for (Choice& choice : choices) {
        const PlaneSides sides = sides_of(choice.plane, graphs_.model(), cycles.polygons);
        const auto& [front, back] = sides.sets;
        const auto front_edges =
            cyclic_.count(cycles.inner, cycles.polygons, back, front, sides.unseen_in_front);
        const auto back_edges =
            cyclic_.count(cycles.inner, cycles.polygons, front, back, sides.unseen_behind);
        choice.cost = cost(front_edges, back_edges, cycles.edges);
    }
    std::sort(choices.begin(), choices.end());
}

Fork TreeBuilder::fork(const EyeNode& node, const Plane& plane) {
    const SideSets sides = sides_of(plane, graphs_.model(), node.cycles.polygons).sets;
    const SideSets turned{sides.back_or_on, sides.front_or_on};
    return {
        plane,
        part_of(graphs_, node, *node.region.cut(plane), &sides),
        part_of(graphs_, node, *node.region.cut(reversed(plane)), &turned)};
}

/// By the plane that leaves least on rings; for graphs of some size as judged by sides. Nothing
/// when no plane makes the node simpler.
std::optional<Fork> TreeBuilder::best_fork(const EyeNode& node) {
    const Cycles& cycles = node.cycles;
    std::vector<Choice> ranked =
        by_sides(node, candidate_planes(graphs_.model(), cycles.polygons, search_.edge_planes));
    if (ranked.empty()) {
        // Of many polygons not all planes were made. Those of one ring end it in time.
        const auto ring = shortest_ring(cycles.inner, cycles.polygons);
        ranked = by_sides(node, candidate_planes(graphs_.model(), ring, search_.edge_planes));
    }
    const std::size_t tried = cycles.edges > most_exact_edges ? 1 : search_.exact;
    ranked.resize(std::min(tried, ranked.size()));
    std::optional<Fork> best;
    Choice least{.plane = {}, .cost = HUGE_VAL, .number = ranked.size()};
    for (const Choice& choice : ranked) {
        Fork made = fork(node, choice.plane);
        const double left = cost(made.front.cycles.edges, made.back.cycles.edges, cycles.edges);
        if (const Choice exact{choice.plane, left, choice.number}; !best || exact < least) {
            least = exact;
            best = std::move(made);
        }
    }
    return best;
}

std::unique_ptr<Branch> TreeBuilder::leaf(const EyeNode& node) {
    auto out = std::make_unique<Branch>();
    out->list = list_of(graphs_, node);
    out->planes = node.region.planes();
    out->polygons = node.graph.count();
    entries_ += out->list.size();
    check_entries(entries_, node.graph.count());
    return out;
}

/// Splits polygons until an eye in the middle of the node meets no ring, and some plane makes it
/// simpler. No fork if none is needed any more.
std::optional<Fork> TreeBuilder::settle(EyeNode& node) {
    while (node.cycles.edges > 0) {
        std::optional<Deadlock> deadlock = ring_at_eye(graphs_, node);
        if (!deadlock) {
            if (auto fork = best_fork(node)) {
                return fork;
            }
            deadlock = Deadlock{node.cycles.components.front(), node.region, std::nullopt};
        }
        work_.resolve(*deadlock);
        work_.catch_up(node);
        node = part_of(graphs_, node, node.region);
    }
    return std::nullopt;
}

std::unique_ptr<Branch> TreeBuilder::grow(EyeNode node, std::size_t depth) {
    if (depth == most_depth) {
        throw Error(fmt::format(
            "expected a model with painting orders, got one of {} polygons that no {} planes order",
            node.graph.count(),
            most_depth));
    }
    if (work_.catch_up(node)) {
        node = part_of(graphs_, node, node.region);
    }
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

/// The number of a branch, as a child of a node.
int flatten(Branch& branch, const WorkingModel& work, RegionTree& out) {
    if (!branch.plane) {
        work.catch_up(branch.list, branch.polygons);
        out.lists.push_back(std::move(branch.list));
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
    const auto branch = TreeBuilder(work, search).grow(root, 0);
    RegionTree tree;
    flatten(*branch, work, tree);
    return tree;
}

} // namespace octant::visuals::draworder
