#include "visuals/draworder/region_tree.h"

#include "sim/base/error.h"
#include "visuals/draworder/candidate_planes.h"
#include "visuals/draworder/components.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// 16 bytes each with what a renderer makes of them.
constexpr std::size_t most_entries = 8'000'000;
constexpr std::size_t most_edge_planes = 8'000;
constexpr std::size_t looked_at_closer = 48;
/// Graphs with more edges are judged by sides alone.
constexpr std::size_t most_exact_edges = 4'000;
constexpr int most_depth = 100;

/// A cell to be, or a cut.
struct Branch {
    std::optional<Plane> plane;
    std::unique_ptr<Branch> front;
    std::unique_ptr<Branch> back;
    std::vector<std::uint32_t> list;
    std::vector<Plane> planes;
    std::size_t leaves = 1;
};

struct EyeNode {
    EyeRegion region;
    HidingGraph graph;
    Cycles cycles;
};

struct Choice {
    Plane plane;
    PlaneSides sides;
    double cost = 0.0;
    std::size_t number = 0;

    bool operator<(const Choice& other) const {
        return std::pair(cost, number) < std::pair(other.cost, other.number);
    }
};

Plane reversed(const Plane& plane) {
    return {-plane.normal, -plane.offset_m};
}

class TreeBuilder {
public:
    TreeBuilder(RegionGraphs& graphs, const TreeSearch& search)
        : graphs_(graphs)
        , search_(search) {}

    std::unique_ptr<Branch> grow(EyeNode node, std::size_t depth);

    std::optional<Deadlock> deadlock;

private:
    std::unique_ptr<Branch> leaf(const EyeNode& node);
    bool deadlocked(const EyeNode& node);
    std::vector<Choice> by_sides(const EyeNode& node);
    std::vector<Choice> choices(const EyeNode& node);
    EyeNode child(const EyeNode& node, EyeRegion region, const SideSets& sides);
    std::optional<std::pair<EyeNode, EyeNode>> children(const EyeNode& node, const Choice& choice);
    double cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const;

    RegionGraphs& graphs_;
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

/// Edges of `inner` that end on one side of a plane because of where its polygons lie.
std::size_t ended_edges(
    const Cycles& cycles,
    const PolygonSet& hidden,
    const PolygonSet& hiding,
    const PolygonSet& unseen) {
    std::size_t ended = 0;
    for (const std::uint32_t a : cycles.polygons) {
        const auto row = cycles.inner.row(a);
        const std::uint64_t whole = unseen.has(a) ? ~std::uint64_t{0} : 0;
        const std::uint64_t parted = hidden.has(a) ? ~std::uint64_t{0} : 0;
        for (std::size_t word = 0; word < row.size(); ++word) {
            const std::uint64_t mask =
                whole | unseen.words()[word] | (parted & hiding.words()[word]);
            ended += static_cast<std::size_t>(std::popcount(row[word] & mask));
        }
    }
    return ended;
}

std::vector<Choice> TreeBuilder::by_sides(const EyeNode& node) {
    const Cycles& cycles = node.cycles;
    std::vector<Choice> best;
    std::size_t number = 0;
    for (const Plane& plane :
         candidate_planes(graphs_.model(), cycles.polygons, most_edge_planes)) {
        PlaneSides sides = sides_of(plane, graphs_.model(), cycles.polygons);
        const auto& [front, back] = sides.sets;
        const std::size_t front_edges =
            cycles.edges - ended_edges(cycles, front, back, sides.unseen_in_front);
        const std::size_t back_edges =
            cycles.edges - ended_edges(cycles, back, front, sides.unseen_behind);
        const double value = cost(front_edges, back_edges, cycles.edges);
        ++number;
        if (value == HUGE_VAL || (best.size() == looked_at_closer && value >= best.back().cost)) {
            continue;
        }
        Choice choice{plane, std::move(sides), value, number};
        best.insert(std::upper_bound(best.begin(), best.end(), choice), std::move(choice));
        if (best.size() > looked_at_closer) {
            best.pop_back();
        }
    }
    for (Choice& choice : best) {
        const auto& [front, back] = choice.sides.sets;
        const auto front_edges =
            cyclic_.count(cycles.inner, cycles.polygons, back, front, choice.sides.unseen_in_front);
        const auto back_edges =
            cyclic_.count(cycles.inner, cycles.polygons, front, back, choice.sides.unseen_behind);
        choice.cost = cost(front_edges, back_edges, cycles.edges);
    }
    std::sort(best.begin(), best.end());
    return best;
}

EyeNode TreeBuilder::child(const EyeNode& node, EyeRegion region, const SideSets& sides) {
    const auto& among = node.cycles.polygons;
    const HidingGraph left = graphs_.surviving(region, node.cycles.inner, among, &sides);
    HidingGraph graph = node.graph;
    for (const std::uint32_t a : among) {
        const auto inner = node.cycles.inner.row(a);
        const auto row = graph.row(a);
        for (std::size_t word = 0; word < row.size(); ++word) {
            row[word] = (row[word] & ~inner[word]) | left.row(a)[word];
        }
    }
    return {std::move(region), std::move(graph), cycles_of(left, among)};
}

std::optional<std::pair<EyeNode, EyeNode>>
TreeBuilder::children(const EyeNode& node, const Choice& choice) {
    auto front = node.region.cut(choice.plane);
    auto back = node.region.cut(reversed(choice.plane));
    if (!front || !back) {
        return std::nullopt;
    }
    const SideSets& sides = choice.sides.sets;
    return std::pair(
        child(node, std::move(*front), sides),
        child(node, std::move(*back), {sides.back_or_on, sides.front_or_on}));
}

/// The planes that promise most, best first; for graphs of some size as judged by sides.
std::vector<Choice> TreeBuilder::choices(const EyeNode& node) {
    std::vector<Choice> ranked = by_sides(node);
    const auto cuts = [&](const Choice& choice) {
        return node.region.reaches_front_of(choice.plane) &&
               node.region.reaches_front_of(reversed(choice.plane));
    };
    std::erase_if(ranked, [&](const Choice& choice) { return !cuts(choice); });
    if (node.cycles.edges > most_exact_edges || ranked.size() < 2) {
        return ranked;
    }
    ranked.erase(
        ranked.begin() + static_cast<std::ptrdiff_t>(std::min(search_.exact, ranked.size())),
        ranked.end());
    for (Choice& choice : ranked) {
        const auto pair = children(node, choice);
        choice.cost =
            pair ? cost(pair->first.cycles.edges, pair->second.cycles.edges, node.cycles.edges)
                 : HUGE_VAL;
    }
    std::sort(ranked.begin(), ranked.end());
    return ranked;
}

bool TreeBuilder::deadlocked(const EyeNode& node) {
    const auto& among = node.cycles.polygons;
    const glm::dvec3 eye = node.region.some_eye();
    const Cycles ring = cycles_of(graphs_.at_eye(eye, node.cycles.inner, among), among);
    if (ring.edges > 0) {
        deadlock = Deadlock{ring.components.front(), eye};
    }
    return ring.edges > 0;
}

std::unique_ptr<Branch> TreeBuilder::leaf(const EyeNode& node) {
    auto out = std::make_unique<Branch>();
    const PolygonSet listed = graphs_.listed(node.region);
    const auto pairs = node.graph.precedences(listed);
    for (const std::uint32_t polygon : paint_sequence(node.graph.count(), pairs).order) {
        if (listed.has(polygon)) {
            out->list.push_back(polygon);
        }
    }
    out->planes = node.region.planes();
    entries_ += out->list.size();
    if (entries_ > most_entries) {
        throw Error(fmt::format(
            "expected a model whose painting orders fit {} entries, got more: its {} polygons hide "
            "one another in too many ways",
            most_entries,
            node.graph.count()));
    }
    return out;
}

std::unique_ptr<Branch> TreeBuilder::grow(EyeNode node, std::size_t depth) {
    if (node.cycles.edges == 0) {
        return leaf(node);
    }
    if (deadlocked(node)) {
        return nullptr;
    }
    const std::vector<Choice> ranked = choices(node);
    const std::size_t width = depth < search_.widths.size() ? search_.widths[depth] : 1;
    std::unique_ptr<Branch> best;
    for (std::size_t i = 0; i < std::min(width, ranked.size()); ++i) {
        auto pair = children(node, ranked[i]);
        if (!pair) {
            continue;
        }
        auto out = std::make_unique<Branch>();
        out->plane = ranked[i].plane;
        out->front = grow(std::move(pair->first), depth + 1);
        out->back = out->front ? grow(std::move(pair->second), depth + 1) : nullptr;
        if (!out->back) {
            return nullptr;
        }
        out->leaves = out->front->leaves + out->back->leaves;
        if (!best || out->leaves < best->leaves) {
            best = std::move(out);
        }
    }
    if (!best && !deadlock) {
        deadlock = Deadlock{node.cycles.components.front(), std::nullopt};
    }
    return best;
}

/// The number of a branch, as a child of a node.
int flatten(Branch& branch, RegionTree& out) {
    if (!branch.plane) {
        out.lists.push_back(std::move(branch.list));
        out.cell_planes.push_back(std::move(branch.planes));
        return ~static_cast<int>(out.lists.size() - 1);
    }
    const std::size_t at = out.nodes.size();
    out.nodes.push_back({*branch.plane, 0, 0});
    const int front = flatten(*branch.front, out);
    const int back = flatten(*branch.back, out);
    out.nodes[at].front = front;
    out.nodes[at].back = back;
    return static_cast<int>(at);
}

} // namespace

TreeResult region_tree(
    RegionGraphs& graphs,
    const EyeRegion& region,
    const HidingGraph& graph,
    const TreeSearch& search) {
    TreeBuilder builder(graphs, search);
    const auto root = builder.grow({region, graph, cycles_of(graph)}, 0);
    TreeResult result{.tree = {}, .deadlock = builder.deadlock};
    if (root) {
        flatten(*root, result.tree);
    }
    return result;
}

} // namespace octant::visuals::draworder
