// Which plane divides a node of the tree over eye space. Candidate planes are judged in three
// stages, each more exact and more expensive, and applied to fewer planes: by where polygons lie to
// the plane (PlaneScorer), by the edges that stay on cycles then (CyclicEdgeCounter), and by building both
// sides' graphs with the exact hiding test. The plane with the least cost divides the node.
#include "visuals/draworder/split_plane_search.h"

#include "sim/base/plane.h"
#include "visuals/draworder/candidate_planes.h"
#include "visuals/draworder/components.h"
#include "visuals/draworder/plane_scorer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <future>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

/// Calls both functions, the first one on a thread of its own if `worthwhile`, and returns both
/// results. Neither may write to what the other one uses, so that the result is the same either
/// way.
template <typename PaintFirst, typename Second>
auto both(bool worthwhile, PaintFirst first, Second second) {
    auto there =
        std::async(worthwhile ? std::launch::async : std::launch::deferred, std::move(first));
    auto here = second();
    return std::pair(there.get(), std::move(here));
}

/// Graphs with more edges are judged without the exact test.
constexpr std::size_t max_exact_edges = 4'000;
/// When the first planes lead nowhere, so many times as many are tried.
constexpr std::size_t more_planes = 16;

/// A candidate plane with its estimated cost. The number tells equal ones apart.
struct ViewSplit {
    Plane plane;
    double cost = 0.0;
    std::size_t number = 0;

    bool operator<(const ViewSplit& other) const {
        return std::pair(cost, number) < std::pair(other.cost, other.number);
    }
};

/// Whether a node's work is worth a second thread.
bool is_large(const ViewCell& node) {
    return node.cycles.edges > 500;
}

/// The work of judging a plane by where polygons lie to it.
std::uint64_t units_of_plane(const CyclicPart& cycles) {
    constexpr std::size_t sampled_rows = 192;
    std::size_t words = 0;
    for (const auto& component : cycles.components) {
        words += std::min(component.size(), sampled_rows) * (component.size() / 64 + 1);
    }
    return 15 * cycles.polygons.size() + 4 * words;
}

/// The work of counting the edges that a plane leaves on cycles.
std::uint64_t units_of_rings(const CyclicPart& cycles) {
    const std::size_t words = cycles.inner.count() / 64 + 1;
    return 2 * (30 + 4 * words) * cycles.polygons.size() + 4 * cycles.edges;
}

/// Judges the planes that may divide one node.
class SplitPlaneChooser {
public:
    SplitPlaneChooser(const WorkingModel& work, const ViewCell& node, const SplitPlaneSearch& search)
        : work_(work)
        , node_(node)
        , search_(search) {}

    std::optional<CellSplit> best() const;

private:
    std::vector<ViewSplit> by_sides(std::span<const Plane> planes, std::size_t first_number) const;
    std::vector<ViewSplit> by_rings(std::span<const ViewSplit> choices) const;
    std::vector<ViewSplit> ranked(std::span<const Plane> planes) const;
    std::vector<ViewSplit> of_planes(std::span<const std::uint32_t> among, std::size_t most) const;
    std::vector<ViewSplit> coarse_ranking() const;
    CellSplit fork(const Plane& plane) const;
    double cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const;
    double little_gain(std::size_t before) const;

    const WorkingModel& work_;
    const ViewCell& node_;
    const SplitPlaneSearch& search_;
};

/// The cost of a plane that leaves so many cyclic edges in front and behind, of `before`; less is
/// better. A side that stays as it was is no gain at all and costs infinitely much.
double SplitPlaneChooser::cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const {
    if (front_edges >= before || back_edges >= before) {
        return HUGE_VAL;
    }
    return std::pow(static_cast<double>(front_edges), search_.power) +
           std::pow(static_cast<double>(back_edges), search_.power);
}

/// The cost of a plane that leaves 15 of 16 edges on both sides.
double SplitPlaneChooser::little_gain(std::size_t before) const {
    const std::size_t left = before - before / 16;
    return cost(left, left, before + 1);
}

/// First stage: the best planes by where polygons lie to them. `first_number` is the number of the
/// first plane.
std::vector<ViewSplit>
SplitPlaneChooser::by_sides(std::span<const Plane> planes, std::size_t first_number) const {
    const CyclicPart& cycles = node_.cycles;
    PlaneScorer scorer(work_.faces, cycles);
    std::vector<ViewSplit> best;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const Plane& plane = planes[i];
        if (!node_.region.intersects_front_of(plane) ||
            !node_.region.intersects_front_of(turned_over(plane))) {
            continue;
        }
        const double limit = best.size() == search_.coarse_candidates ? best.back().cost : HUGE_VAL;
        scorer.set_plane(plane);
        const std::size_t front_edges = scorer.edges_left_in_front();
        if (cost(front_edges, 0, cycles.edges) >= limit) {
            continue;
        }
        const double value = cost(front_edges, scorer.edges_left_behind(), cycles.edges);
        if (value >= limit) {
            continue;
        }
        const ViewSplit choice{plane, value, first_number + i};
        best.insert(std::upper_bound(best.begin(), best.end(), choice), choice);
        if (best.size() > search_.coarse_candidates) {
            best.pop_back();
        }
    }
    return best;
}

/// Second stage: the cost of each choice by the edges that stay on cycles.
std::vector<ViewSplit> SplitPlaneChooser::by_rings(std::span<const ViewSplit> choices) const {
    const CyclicPart& cycles = node_.cycles;
    CyclicEdgeCounter rings;
    std::vector<ViewSplit> out(choices.begin(), choices.end());
    for (ViewSplit& choice : out) {
        const PolygonsByPlaneSide sides = sides_of(choice.plane, work_.faces, cycles.polygons);
        const auto& [front, back] = sides.sets;
        const auto front_edges =
            rings.count(cycles.inner, cycles.polygons, back, front, sides.back_facing_in_front);
        const auto back_edges =
            rings.count(cycles.inner, cycles.polygons, front, back, sides.back_facing_behind);
        choice.cost = cost(front_edges, back_edges, cycles.edges);
    }
    return out;
}

/// Both stages over many planes, on two threads; best first.
std::vector<ViewSplit> SplitPlaneChooser::ranked(std::span<const Plane> planes) const {
    work_.spend(planes.size() * units_of_plane(node_.cycles));
    const bool large = is_large(node_);
    const std::size_t half = planes.size() / 2;
    auto [choices, others] = both(
        large,
        [&] { return by_sides(planes.first(half), 0); },
        [&] { return by_sides(planes.subspan(half), half); });
    choices.insert(choices.end(), others.begin(), others.end());
    std::sort(choices.begin(), choices.end());
    choices.resize(std::min(search_.coarse_candidates, choices.size()));
    work_.spend(choices.size() * units_of_rings(node_.cycles));
    const std::size_t middle = choices.size() / 2;
    const std::span<const ViewSplit> all(choices);
    auto [judged, rest] = both(
        large,
        [&] { return by_rings(all.first(middle)); },
        [&] { return by_rings(all.subspan(middle)); });
    judged.insert(judged.end(), rest.begin(), rest.end());
    std::sort(judged.begin(), judged.end());
    return judged;
}

/// Divides a node by a plane, with the exact test on both sides.
CellSplit SplitPlaneChooser::fork(const Plane& plane) const {
    const PlaneSideSets sides = sides_of(plane, work_.faces, node_.cycles.polygons).sets;
    const PlaneSideSets turned{sides.back_or_on, sides.front_or_on};
    const auto part = [&](const Plane& before, const PlaneSideSets& sets) {
        OcclusionGraphBuilder graphs(work_.faces);
        return part_of(graphs, node_, *node_.region.cut(before), &sets);
    };
    auto [front, back] = both(
        is_large(node_),
        [&] { return part(plane, sides); },
        [&] { return part(turned_over(plane), turned); });
    return {plane, std::move(front), std::move(back)};
}

/// The choices by the candidate planes of some polygons, of which there are about `most`.
std::vector<ViewSplit>
SplitPlaneChooser::of_planes(std::span<const std::uint32_t> among, std::size_t most) const {
    std::vector<Plane> planes;
    if (search_.tries_axis_planes_first) {
        planes = axis_planes(work_.faces, among, 2 * most);
    }
    const auto others = candidate_planes(work_.faces, among, most);
    planes.insert(planes.end(), others.begin(), others.end());
    return ranked(planes);
}

/// The choices of the first planes or, where these lead nowhere, of more.
std::vector<ViewSplit> SplitPlaneChooser::coarse_ranking() const {
    const CyclicPart& cycles = node_.cycles;
    std::vector<ViewSplit> choices = of_planes(cycles.polygons, search_.edge_planes);
    if (choices.empty() || choices.front().cost > little_gain(cycles.edges)) {
        choices = of_planes(cycles.polygons, more_planes * search_.edge_planes);
    }
    if (choices.empty()) {
        // Of many polygons not all candidate planes were made. All those of one ring are enough to
        // resolve it in the end.
        choices = of_planes(shortest_cycle(cycles.inner, cycles.polygons), search_.edge_planes);
    }
    return choices;
}

/// Third stage: divides the node by each of the best choices and keeps the best result; for very
/// large graphs only the first choice.
std::optional<CellSplit> SplitPlaneChooser::best() const {
    const CyclicPart& cycles = node_.cycles;
    std::vector<ViewSplit> choices = coarse_ranking();
    const std::size_t tried = cycles.edges > max_exact_edges ? 1 : search_.exact;
    choices.resize(std::min(tried, choices.size()));
    work_.spend(2 * choices.size() * search_units(node_));
    std::optional<CellSplit> best;
    ViewSplit least{.plane = {}, .cost = HUGE_VAL, .number = choices.size()};
    for (const ViewSplit& choice : choices) {
        CellSplit made = fork(choice.plane);
        const double left = cost(made.front.cycles.edges, made.back.cycles.edges, cycles.edges);
        if (const ViewSplit exact{choice.plane, left, choice.number}; !best || exact < least) {
            least = exact;
            best = std::move(made);
        }
    }
    return best;
}

} // namespace

std::optional<CellSplit>
best_split(const WorkingModel& work, const ViewCell& node, const SplitPlaneSearch& search) {
    return SplitPlaneChooser(work, node, search).best();
}

} // namespace octant::visuals::draworder
