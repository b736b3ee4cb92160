// OrderMethod::Exact: painting orders for every eye, the model's inside included. Section IV of the 1989 paper divides
// the viewing directions until all hidden surfaces are removed; here eye space is divided by planes until each cell's
// occlusion graph has no cycle.
//
// The search is greedy: at a node the plane that leaves least of the cycles divides it (SplitPlaneChooser::best).
// Before that, an eye in the middle of the node is looked at: if it already sees a cycle, no plane can help, and a
// polygon is split.
#include "visuals/draworder/view_space_tree.h"

#include "sim/base/plane.h"
#include "sim/base/thread_pool.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/search_budget.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

// Where to cut eye space. Section IV of the 1989 paper divides the viewing directions further until all hidden surfaces
// are removed, but does not say where. Whether B hides part of A changes only as the eye crosses a plane through an
// edge of one and a corner of the other, or one of their own planes (the planes of the aspect graph); these are the
// candidates.

namespace {

/// Points and planes closer than this count as one.
constexpr double grain = 1e-6;

/// A number in units of `grain`, for comparisons with tolerance.
std::int64_t grains(double value) { return std::llround(value / grain); }

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The corners and edges of some polygons' outlines, equal ones merged, in the order in which the polygons name them: a
/// model that is turned gets the same numbers.
struct Outlines {
    std::vector<glm::dvec3> corners; ///< Each position once.
    std::vector<Edge> edges;         ///< Each edge once, as a pair of indices into `corners`.
};

Outlines outlines_of(const ModelFaces& model, std::span<const std::uint32_t> among) {
    using Place = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
    std::map<Place, std::uint32_t> numbers;
    Outlines out;
    const auto number_of = [&](const glm::dvec3& corner) {
        const Place place{grains(corner.x), grains(corner.y), grains(corner.z)};
        const auto next = static_cast<std::uint32_t>(out.corners.size());
        const auto [at, is_new] = numbers.emplace(place, next);
        if (is_new) { out.corners.push_back(corner); }
        return at->second;
    };
    for (const std::uint32_t polygon : among) {
        const Face& face = model.faces[polygon];
        std::vector<std::uint32_t> outline;
        for (const glm::dvec3& corner : face.outline) { outline.push_back(number_of(corner)); }
        for (std::size_t i = 0; i < outline.size() && face.plane && !face.pivot; ++i) {
            const std::uint32_t next = outline[(i + 1) % outline.size()];
            out.edges.emplace_back(std::min(outline[i], next), std::max(outline[i], next));
        }
    }
    std::ranges::sort(out.edges);
    out.edges.erase(std::unique(out.edges.begin(), out.edges.end()), out.edges.end());
    return out;
}

/// The step with which about `most` of `all` items are taken.
std::size_t stride(std::size_t all, std::size_t most) { return all / most + 1; }

void add_edge_planes(std::vector<Plane>& planes, const Outlines& outlines, std::size_t most) {
    const std::size_t all = outlines.edges.size() * outlines.corners.size();
    for (std::size_t i = 0; i < all; i += stride(all, most)) {
        const Edge& edge = outlines.edges[i / outlines.corners.size()];
        const glm::dvec3& corner = outlines.corners[i % outlines.corners.size()];
        const glm::dvec3& from = outlines.corners[edge.first];
        const glm::dvec3 along = outlines.corners[edge.second] - from;
        const glm::dvec3 across = glm::cross(along, corner - from);
        const double area = glm::length(across);
        if (area > 1e-6 * glm::length(along)) {
            const glm::dvec3 normal = across / area;
            planes.push_back({normal, -glm::dot(normal, from)});
        }
    }
}

/// A key of a plane that is the same for both of its orientations.
std::array<std::int64_t, 4> key_of(const Plane& plane) {
    std::array<std::int64_t, 4> key{
        grains(plane.normal.x), grains(plane.normal.y), grains(plane.normal.z), grains(plane.offset_m)};
    for (const std::int64_t part : key) {
        if (part != 0) {
            if (part < 0) {
                std::ranges::transform(key, key.begin(), [](std::int64_t k) { return -k; });
            }
            break;
        }
    }
    return key;
}

/// The planes without repetition, in their order.
std::vector<Plane> each_once(const std::vector<Plane>& planes) {
    std::vector<std::pair<std::array<std::int64_t, 4>, std::size_t>> keys;
    for (std::size_t i = 0; i < planes.size(); ++i) { keys.emplace_back(key_of(planes[i]), i); }
    std::ranges::sort(keys);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (i == 0 || keys[i].first != keys[i - 1].first) { kept.push_back(keys[i].second); }
    }
    std::ranges::sort(kept);
    std::vector<Plane> out;
    for (const std::size_t i : kept) { out.push_back(planes[i]); }
    return out;
}

/// Planes by which eye space may be cut so that the occlusion relation among some polygons gets simpler, each once, the
/// plainest first: the polygons' own planes, and planes through an edge of one polygon and a corner of another. The
/// last kind includes all that bound the region from where one polygon hides another, so that cutting by them resolves
/// every pair in the end. About `most` of them are made, spread evenly over all that there are. A model that is turned
/// gets the same planes, turned.
std::vector<Plane> candidate_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most) {
    const Outlines outlines = outlines_of(model, among);
    std::vector<Plane> planes;
    for (const std::uint32_t polygon : among) {
        if (model.faces[polygon].plane) { planes.push_back(*model.faces[polygon].plane); }
    }
    add_edge_planes(planes, outlines, most);
    return each_once(planes);
}

/// Where a face lies to a plane. Both are true when it lies in the plane, and neither when it straddles it.
struct PlaneSide {
    bool before = false;
    bool behind = false;
};

PlaneSide side_of(const Plane& plane, const Face& face, double on_plane) {
    double least = on_plane;
    double largest = -on_plane;
    for (const glm::dvec3& corner : face.corners) {
        const double height = distance_m(plane, corner);
        least = std::min(least, height);
        largest = std::max(largest, height);
    }
    return {least >= -on_plane, largest <= on_plane};
}

} // namespace

PolygonsByPlaneSide sides_of(const Plane& plane, const ModelFaces& model, std::span<const std::uint32_t> among) {
    PolygonsByPlaneSide sides(model.faces.size());
    for (const std::uint32_t polygon : among) {
        const Face& face = model.faces[polygon];
        const auto [before, behind] = side_of(plane, face, model.tolerances.on_plane);
        if (before) { sides.sets.front_or_on.add(polygon); }
        if (behind) { sides.sets.back_or_on.add(polygon); }
        if (before && behind && face.plane) {
            const bool along = glm::dot(plane.normal, face.plane->normal) > 0.0;
            (along ? sides.back_facing_behind : sides.back_facing_in_front).add(polygon);
        }
    }
    return sides;
}

// Which plane divides a node of the tree over eye space. Candidate planes are judged in three stages, each more exact
// and more expensive, and applied to fewer planes: by where polygons lie to the plane (PlaneScorer), by the edges that
// stay on cycles then (CyclicEdgeCounter), and by building both sides' graphs with the exact occlusion test. The plane
// with the least cost divides the node.

// The first and coarsest of the three stages. For eyes in front of a plane, a polygon behind it or in it cannot hide
// one in front of it or in it, so such edges disappear; counting them takes a few operations on rows of bits. What
// remains may still contain edges that the exact test would remove.

namespace {

/// Of a component at most about this many rows are looked at.
constexpr std::size_t max_rows = 192;

bool has(const std::vector<std::uint64_t>& words, std::size_t first_word, std::size_t bit) {
    return ((words[first_word + bit / 64] >> (bit % 64)) & 1U) != 0;
}

/// A bounding sphere: the mean of the corners and the distance of the farthest one.
std::pair<glm::dvec3, double> ball_around(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) { middle += corner / static_cast<double>(corners.size()); }
    double radius = 0.0;
    for (const glm::dvec3& corner : corners) { radius = std::max(radius, glm::distance(corner, middle)); }
    return {middle, radius};
}

void set(std::vector<std::uint64_t>& words, std::size_t first_word, std::size_t bit) {
    words[first_word + bit / 64] |= std::uint64_t{1} << (bit % 64);
}

/// Estimates what a plane that cuts eye space leaves of the cyclic edges, from where polygons lie to the plane alone.
/// This is quick, so that thousands of planes can be judged. The edges of each component are held in rows of their own,
/// so that small components of large models cost little; of large components only some rows are looked at, evenly
/// spread, and stand for all. Keeps a reference to the faces.
class PlaneScorer {
public:
    PlaneScorer(const ModelFaces& model, const CyclicPart& cycles) : model_(model), edges_(cycles.edges) {
        for (const std::vector<std::uint32_t>& component : cycles.components) { add(cycles.inner, component); }
    }

    /// Turns to a plane.
    void set_plane(const Plane& plane) {
        for (Words* sets : {&front_or_on_, &back_or_on_, &unseen_in_front_, &unseen_behind_}) {
            std::ranges::fill(*sets, std::uint64_t{0});
        }
        some_unseen_ = false;
        const double on = model_.tolerances.on_plane;
        for (const Member& member : members_) {
            const double height = distance_m(plane, member.middle);
            PlaneSide side{height > member.radius, height < -member.radius};
            if (!side.before && !side.behind) { side = side_of(plane, model_.faces[member.polygon], on); }
            if (side.before) { set(front_or_on_, member.first_word, member.bit); }
            if (side.behind) { set(back_or_on_, member.first_word, member.bit); }
            const auto& own = model_.faces[member.polygon].plane;
            if (side.before && side.behind && own) {
                const bool along = glm::dot(plane.normal, own->normal) > 0.0;
                set(along ? unseen_behind_ : unseen_in_front_, member.first_word, member.bit);
                some_unseen_ = true;
            }
        }
    }

    /// The number of cyclic edges that remain for eyes in front of the plane, whether still on cycles or not.
    std::size_t edges_left_in_front() const { return left(front_or_on_, back_or_on_, unseen_in_front_); }

    /// The number of cyclic edges that remain for eyes behind the plane.
    std::size_t edges_left_behind() const { return left(back_or_on_, front_or_on_, unseen_behind_); }

private:
    /// A polygon of a component, with a bounding sphere, and where its bits are.
    struct Member {
        std::uint32_t polygon = 0;
        glm::dvec3 middle{0.0};
        double radius = 0.0;
        /// The index of its component's first word in the sets below.
        std::size_t first_word = 0;
        /// Its own bit, counted from that word.
        std::size_t bit = 0;
        /// The index of its row's first word in rows_.
        std::size_t first_row_word = 0;
        std::size_t words = 0;
        /// How many rows its row stands for; 0 when it has none.
        std::size_t weight = 0;
    };

    using Words = std::vector<std::uint64_t>;

    /// Adds the rows of a component.
    void add(const OcclusionGraph& graph, const std::vector<std::uint32_t>& component) {
        const std::size_t words = (component.size() + 63) / 64;
        const std::size_t step = component.size() / max_rows + 1;
        const std::size_t first_word = front_or_on_.size();
        for (Words* sets : {&front_or_on_, &back_or_on_, &unseen_in_front_, &unseen_behind_}) {
            sets->resize(first_word + words, 0);
        }
        for (std::size_t bit = 0; bit < component.size(); ++bit) {
            const std::uint32_t polygon = component[bit];
            const auto [middle, radius] = ball_around(model_.faces[polygon].corners);
            const std::size_t weight = bit % step == 0 ? step : 0;
            members_.push_back({polygon, middle, radius, first_word, bit, rows_.size(), words, weight});
            if (weight == 0) { continue; }
            rows_.resize(rows_.size() + words, 0);
            for (std::size_t other = 0; other < component.size(); ++other) {
                if (graph.occludes(component[other], polygon)) { set(rows_, members_.back().first_row_word, other); }
            }
        }
    }

    /// The number of edges that do not disappear on one side of the plane: `occluded` are the polygons on that side or
    /// in the plane, `occluders` those on the other side or in it, and `unseen` those that face away from all eyes
    /// there.
    std::size_t left(const Words& occluded, const Words& occluders, const Words& unseen) const {
        std::size_t ended = 0;
        Words mask;
        for (const Member& member : members_) {
            const auto row = std::span(rows_).subspan(member.first_row_word, member.words);
            if (member.weight == 0) { continue; }
            const bool parted = has(occluded, member.first_word, member.bit);
            if (!some_unseen_) {
                const auto others = std::span(occluders).subspan(member.first_word, member.words);
                ended += parted ? member.weight * count_common_bits(row, others) : 0;
                continue;
            }
            const bool is_unseen = has(unseen, member.first_word, member.bit);
            mask.resize(member.words);
            for (std::size_t word = 0; word < member.words; ++word) {
                const std::size_t at = member.first_word + word;
                mask[word] = is_unseen ? ~std::uint64_t{0} : unseen[at] | (parted ? occluders[at] : std::uint64_t{0});
            }
            ended += member.weight * count_common_bits(row, mask);
        }
        return edges_ - std::min(ended, edges_);
    }

    const ModelFaces& model_;
    std::vector<Member> members_;
    Words rows_;
    Words front_or_on_;
    Words back_or_on_;
    Words unseen_in_front_;
    Words unseen_behind_;
    bool some_unseen_ = false;
    std::size_t edges_ = 0;
};

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
bool is_large(const ViewCell& node) { return node.cycles.edges > 500; }

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
std::uint64_t units_of_cycles(const CyclicPart& cycles) {
    const std::size_t words = cycles.inner.count() / 64 + 1;
    return 2 * (30 + 4 * words) * cycles.polygons.size() + 4 * cycles.edges;
}

/// A node that was divided by a plane.
struct CellSplit {
    Plane plane;
    ViewCell front;
    ViewCell back;
};

/// Judges the planes that may divide one node.
class SplitPlaneChooser {
public:
    SplitPlaneChooser(const WorkingModel& work, const ViewCell& node, const SplitPlaneSearch& search)
        : work_(work), node_(node), search_(search) {}

    /// Third stage: divides the node by each of the best choices and keeps the best result; for very large graphs only
    /// the first choice.
    std::optional<CellSplit> best() const {
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

private:
    /// First stage: the best planes by where polygons lie to them. `first_number` is the number of the first plane.
    std::vector<ViewSplit> by_sides(std::span<const Plane> planes, std::size_t first_number) const {
        const CyclicPart& cycles = node_.cycles;
        PlaneScorer scorer(work_.faces, cycles);
        std::vector<ViewSplit> best;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const Plane& plane = planes[i];
            if (!node_.region.intersects_front_of(plane) || !node_.region.intersects_front_of(turned_over(plane))) {
                continue;
            }
            const double limit = best.size() == search_.coarse_candidates ? best.back().cost : HUGE_VAL;
            scorer.set_plane(plane);
            const std::size_t front_edges = scorer.edges_left_in_front();
            if (cost(front_edges, 0, cycles.edges) >= limit) { continue; }
            const double value = cost(front_edges, scorer.edges_left_behind(), cycles.edges);
            if (value >= limit) { continue; }
            const ViewSplit choice{plane, value, first_number + i};
            best.insert(std::upper_bound(best.begin(), best.end(), choice), choice);
            if (best.size() > search_.coarse_candidates) { best.pop_back(); }
        }
        return best;
    }

    /// Second stage: the cost of each choice by the edges that stay on cycles.
    std::vector<ViewSplit> by_cycles(std::span<const ViewSplit> choices) const {
        const CyclicPart& cycles = node_.cycles;
        CyclicEdgeCounter counter;
        std::vector<ViewSplit> out(choices.begin(), choices.end());
        for (ViewSplit& choice : out) {
            const PolygonsByPlaneSide sides = sides_of(choice.plane, work_.faces, cycles.polygons);
            const auto& [front, back] = sides.sets;
            const auto front_edges =
                counter.count(cycles.inner, cycles.polygons, back, front, sides.back_facing_in_front);
            const auto back_edges = counter.count(cycles.inner, cycles.polygons, front, back, sides.back_facing_behind);
            choice.cost = cost(front_edges, back_edges, cycles.edges);
        }
        return out;
    }

    /// Both stages over many planes, on two threads; best first.
    std::vector<ViewSplit> ranked(std::span<const Plane> planes) const {
        work_.spend(planes.size() * units_of_plane(node_.cycles));
        const bool large = is_large(node_);
        const std::size_t half = planes.size() / 2;
        auto [choices, others] = run_both(
            large, [&] { return by_sides(planes.first(half), 0); },
            [&] { return by_sides(planes.subspan(half), half); });
        choices.insert(choices.end(), others.begin(), others.end());
        std::sort(choices.begin(), choices.end());
        choices.resize(std::min(search_.coarse_candidates, choices.size()));
        work_.spend(choices.size() * units_of_cycles(node_.cycles));
        const std::size_t middle = choices.size() / 2;
        const std::span<const ViewSplit> all(choices);
        auto [judged, rest] = run_both(
            large, [&] { return by_cycles(all.first(middle)); }, [&] { return by_cycles(all.subspan(middle)); });
        judged.insert(judged.end(), rest.begin(), rest.end());
        std::sort(judged.begin(), judged.end());
        return judged;
    }

    /// The choices by the candidate planes of some polygons, of which there are about `most`.
    std::vector<ViewSplit> of_planes(std::span<const std::uint32_t> among, std::size_t most) const {
        std::vector<Plane> planes;
        if (search_.first_planes) { planes = search_.first_planes(work_.faces, among, 2 * most); }
        const auto others = candidate_planes(work_.faces, among, most);
        planes.insert(planes.end(), others.begin(), others.end());
        return ranked(planes);
    }

    /// The choices of the first planes or, where these lead nowhere, of more.
    std::vector<ViewSplit> coarse_ranking() const {
        const CyclicPart& cycles = node_.cycles;
        std::vector<ViewSplit> choices = of_planes(cycles.polygons, search_.edge_planes);
        if (choices.empty() || choices.front().cost > little_gain(cycles.edges)) {
            choices = of_planes(cycles.polygons, more_planes * search_.edge_planes);
        }
        if (choices.empty()) {
            // Of many polygons not all candidate planes were made. All those of one cycle are enough to resolve it in
            // the end.
            choices = of_planes(shortest_cycle(cycles.inner, cycles.polygons), search_.edge_planes);
        }
        return choices;
    }

    /// Divides a node by a plane, with the exact test on both sides.
    CellSplit fork(const Plane& plane) const {
        const PlaneSideSets sides = sides_of(plane, work_.faces, node_.cycles.polygons).sets;
        const PlaneSideSets turned{sides.back_or_on, sides.front_or_on};
        const auto part = [&](const Plane& before, const PlaneSideSets& sets) {
            OcclusionGraphBuilder graphs(work_.faces);
            return part_of(graphs, node_, *node_.region.cut(before), &sets);
        };
        auto [front, back] = run_both(
            is_large(node_), [&] { return part(plane, sides); }, [&] { return part(turned_over(plane), turned); });
        return {plane, std::move(front), std::move(back)};
    }

    /// The cost of a plane that leaves so many cyclic edges in front and behind, of `before`; less is better. A side
    /// that stays as it was is no gain at all and costs infinitely much.
    double cost(std::size_t front_edges, std::size_t back_edges, std::size_t before) const {
        if (front_edges >= before || back_edges >= before) { return HUGE_VAL; }
        return std::pow(static_cast<double>(front_edges), search_.power) +
               std::pow(static_cast<double>(back_edges), search_.power);
    }

    /// The cost of a plane that leaves 15 of 16 edges on both sides.
    double little_gain(std::size_t before) const {
        const std::size_t left = before - before / 16;
        return cost(left, left, before + 1);
    }

    const WorkingModel& work_;
    const ViewCell& node_;
    const SplitPlaneSearch& search_;
};

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
    TreeBuilder(WorkingModel& work, const TreeSearch& search) : work_(work), graphs_(work.faces), search_(search) {}

    /// The branch of a node, recursively.
    std::unique_ptr<Branch> grow(ViewCell node, std::size_t depth) {
        if (!search_.keeps_partial_result) { return found(node, depth); }
        try {
            return found(node, depth);
        } catch (const SearchGivenUp& given_up) {
            if (given_up.is_worse_than_best) { throw; }
            incomplete_reason_ = incomplete_reason_.empty() ? given_up.reason : incomplete_reason_;
            return incomplete_leaf(node);
        }
    }

    /// Why the search was given up first; empty if it was not.
    const std::string& incomplete_reason() const { return incomplete_reason_; }

private:
    /// The branch of a node. Throws SearchGivenUp.
    std::unique_ptr<Branch> found(ViewCell& node, std::size_t depth) {
        check_entries(entries_); // where a list was too much already, another one is, too
        if (depth == search_.max_depth) {
            throw SearchGivenUp{fmt::format("{} planes one after another make no cell", search_.max_depth)};
        }
        if (work_.add_new_pieces(node)) { node = part_of(graphs_, node, node.region); }
        work_.spend(search_units(node));
        std::optional<CellSplit> fork = settle(node);
        if (!fork) { return leaf(node); }
        ++cells_;
        check_cost();
        auto out = std::make_unique<Branch>();
        out->plane = fork->plane;
        out->front = grow(std::move(fork->front), depth + 1);
        out->back = grow(std::move(fork->back), depth + 1);
        return out;
    }

    /// The end of a branch where the search is given up.
    std::unique_ptr<Branch> incomplete_leaf(ViewCell& node) {
        work_.add_new_pieces(node);
        auto out = std::make_unique<Branch>();
        out->incomplete_cells = component_sets(graphs_, node);
        out->planes = node.region.planes();
        out->polygons = node.graph.count();
        return out;
    }

    /// The finished cell of a node without cycles.
    std::unique_ptr<Branch> leaf(const ViewCell& node) {
        auto out = std::make_unique<Branch>();
        out->list = list_of(graphs_, node);
        out->planes = node.region.planes();
        out->polygons = node.graph.count();
        entries_ += out->list.size();
        check_entries(entries_);
        return out;
    }

    /// Splits polygons until an eye in the middle of the node sees no cycle and some plane makes the node simpler, and
    /// returns the node divided by that plane. Returns nothing once the node has no cycles.
    std::optional<CellSplit> settle(ViewCell& node) {
        while (node.cycles.edges > 0) {
            std::optional<PersistentCycle> persistent_cycle;
            if (!search_.prefers_planes) { persistent_cycle = cycle_at_eye(graphs_, node); }
            if (!persistent_cycle) {
                if (auto fork = SplitPlaneChooser(work_, node, search_.plane_search).best()) { return fork; }
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

    /// Throws SearchGivenUp where the tree, which only grows, costs too much already.
    void check_cost() const {
        const TreeCost cost{work_.sibling_pieces.size(), cells_};
        const bool costs_more = search_.cost_limit && cost >= *search_.cost_limit;
        const bool splits_more =
            cost.splits > 0 && search_.max_splits && static_cast<int>(cost.splits) > search_.max_splits();
        if (costs_more || splits_more) { throw SearchGivenUp{"another order costs less", true}; }
    }

    WorkingModel& work_;
    OcclusionGraphBuilder graphs_;
    const TreeSearch& search_;
    std::size_t entries_ = 0;
    std::size_t cells_ = 1; ///< Finished ones, and one for each branch that is still to grow.
    std::string incomplete_reason_;
};

/// Appends a branch to the arrays of the tree and returns its number as a child.
int flatten(Branch& branch, const WorkingModel& work, ViewSpaceTree& out) {
    if (!branch.plane) {
        work.add_new_pieces(branch.list, branch.polygons);
        for (std::vector<std::uint32_t>& set : branch.incomplete_cells) { work.add_new_pieces(set, branch.polygons); }
        out.lists.push_back(std::move(branch.list));
        out.incomplete_cells.push_back(std::move(branch.incomplete_cells));
        out.cells.push_back({"", std::move(branch.planes)});
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
    if (!branch->plane && !builder.incomplete_reason().empty()) { throw SearchGivenUp{builder.incomplete_reason()}; }
    ViewSpaceTree tree;
    flatten(*branch, work, tree);
    tree.incomplete_reason = builder.incomplete_reason();
    return tree;
}

namespace {

// As the searches are greedy, small models are searched several times with other weights; the result with the fewest
// splits, then with the fewest cells, is returned.

/// Models with more cyclic edges get one quick search only.
constexpr std::size_t max_edges_searched_again = 2'000;

/// About the work of testing a pair of polygons (SearchBudget).
constexpr std::uint64_t units_of_tree_pair = 300;

/// The searches whose results are compared; the last one only where the others split polygons.
const std::array<TreeSearch, 4> tree_searches{{{.plane_search = {.power = 1.0}, .keeps_partial_result = true},
    {.plane_search = {.power = 0.5}, .keeps_partial_result = true},
    {.plane_search = {.power = 1.5}, .keeps_partial_result = true},
    {.prefers_planes = true, .keeps_partial_result = true}}};
/// Halves first: a plane that only takes something off a large graph leaves nearly all of the work to its children.
const TreeSearch quick_search{.plane_search = {.power = 3.0, .edge_planes = 300, .coarse_candidates = 48, .exact = 2},
    .keeps_partial_result = true};

/// Whether one result is better: complete rather than incomplete, fewer splits, then fewer cells.
bool is_better(const CellSearchResult& a, const CellSearchResult& b) {
    return std::pair(!a.tree.incomplete_reason.empty(), a.cost()) <
           std::pair(!b.tree.incomplete_reason.empty(), b.cost());
}

void keep_better(std::optional<CellSearchResult>& best, CellSearchResult orders) {
    if (!best || is_better(orders, *best)) { best = std::move(orders); }
}

CellSearchResult searched(WorkingModel work, const ViewCell& root, const TreeSearch& search) {
    ViewSpaceTree tree = view_space_tree(work, root, search);
    return {std::move(work), std::move(tree)};
}

} // namespace

CellSearchResult best_tree(
    const models::polygons::PolygonModel& model, SearchBudget& budget, const std::function<int()>& max_splits) {
    WorkingModel work(model, glm::dvec3(0.0));
    work.budget = &budget;
    work.spend(units_of_tree_pair * model.polygons.size() * model.polygons.size());
    OcclusionGraphBuilder graphs(work.faces);
    const ViewCell root = view_cell(graphs, ViewRegion::all_space());
    if (root.cycles.edges > max_edges_searched_again) {
        TreeSearch search = quick_search;
        search.max_splits = max_splits;
        return searched(work, root, search);
    }
    std::optional<CellSearchResult> best;
    std::optional<SearchGivenUp> beaten;
    for (TreeSearch search : tree_searches) {
        if (best && best->work.sibling_pieces.empty() && search.prefers_planes) { break; }
        search.max_splits = max_splits;
        if (best && best->tree.incomplete_reason.empty()) { search.cost_limit = best->cost(); }
        search.keeps_partial_result = search.keeps_partial_result && !search.cost_limit && !beaten;
        try {
            keep_better(best, searched(work, root, search));
        } catch (const SearchGivenUp& given_up) {
            if (given_up.is_worse_than_best) {
                beaten = given_up;
            } else if (!best && !beaten) {
                throw;
            }
        }
    }
    if (!best) { throw SearchGivenUp(*beaten); }
    return std::move(*best);
}

} // namespace octant::visuals::draworder
