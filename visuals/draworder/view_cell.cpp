// A region of eyes with its occlusion graph, and the last resort of the search: where no division of eye space
// gives an order, a polygon is split (section IV and figure 14 of the 1989 paper), and earlier results are updated.
#include "visuals/draworder/view_cell.h"

#include "sim/base/plane.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/search_budget.h"
#include "visuals/draworder/split.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

// The step from a region to a smaller one. Precedences only disappear when a region shrinks, so a child tests no more
// than the cyclic edges of its parent; and an acyclic graph over a region gives, by topological sorting, one list that
// is right for all of its eyes.

void check_entries(std::size_t entries) {
    // Each takes 4 bytes here and some 24 in a renderer's index buffer.
    constexpr std::size_t max_entries = 8'000'000;
    if (entries > max_entries) {
        throw SearchGivenUp{fmt::format("the lists of its cells have more than {} entries", max_entries)};
    }
}

std::uint64_t search_units(const ViewCell& node) {
    constexpr std::uint64_t of_edge = 700;
    constexpr std::uint64_t of_polygon = 2'000;
    const std::uint64_t words = node.graph.count() * (node.graph.count() / 64 + 1);
    return of_edge * node.cycles.edges + of_polygon * node.cycles.polygons.size() + 2 * words;
}

ViewCell view_cell(OcclusionGraphBuilder& graphs, const ViewRegion& region) {
    OcclusionGraph graph = graphs.all(region);
    CyclicPart cycles = cyclic_part_of(graph);
    return {region, std::move(graph), std::move(cycles)};
}

ViewCell part_of(OcclusionGraphBuilder& graphs, const ViewCell& node, ViewRegion part, const PlaneSideSets* sides) {
    const OcclusionGraph& inner = node.cycles.inner;
    const auto& among = node.cycles.polygons;
    const OcclusionGraph remaining = sides != nullptr ? graphs.remaining_in_front(inner, among, *sides) : inner;
    const CyclicPart tested = sides != nullptr ? cyclic_part_of(remaining, among) : node.cycles;
    const OcclusionGraph left = graphs.surviving(part, tested.inner, tested.polygons);
    OcclusionGraph graph = node.graph;
    for (const std::uint32_t a : among) {
        const auto row = graph.row(a);
        for (std::size_t word = 0; word < row.size(); ++word) {
            const std::uint64_t off_cycles = remaining.row(a)[word] & ~tested.inner.row(a)[word];
            row[word] = (row[word] & ~inner.row(a)[word]) | off_cycles | left.row(a)[word];
        }
    }
    return {std::move(part), std::move(graph), cyclic_part_of(left, tested.polygons)};
}

std::optional<PersistentCycle> cycle_at_eye(OcclusionGraphBuilder& graphs, const ViewCell& node) {
    const auto& among = node.cycles.polygons;
    const auto eye = node.region.interior_point();
    if (!eye) { throw SearchGivenUp{"a cell is too thin to hold an eye"}; }
    CyclicPart cycle = cyclic_part_of(graphs.at_eye(*eye, node.cycles.inner, among), among);
    if (cycle.edges == 0) { return std::nullopt; }
    return PersistentCycle{std::move(cycle.components.front()), node.region, eye};
}

std::vector<std::vector<std::uint32_t>> component_sets(const OcclusionGraphBuilder& graphs, const ViewCell& node) {
    const std::size_t count = node.graph.count();
    const BitSet listed = graphs.listed(node.region);
    std::vector<std::vector<std::uint32_t>> sets(count); // by their first polygons
    std::vector<std::size_t> set_of(count);
    std::iota(set_of.begin(), set_of.end(), std::size_t{0});
    for (const auto& component : node.cycles.components) {
        for (const std::uint32_t polygon : component) { set_of[polygon] = component.front(); }
    }
    for_each_bit(listed.words(),
        [&](std::size_t polygon) { sets[set_of[polygon]].push_back(static_cast<std::uint32_t>(polygon)); });
    const auto for_each_edge = [&](std::size_t set, const auto& visit) {
        for (const std::uint32_t polygon : sets[set]) {
            for_each_bit(node.graph.row(polygon), [&](std::size_t later) {
                if (listed.has(later) && set_of[later] != set) { visit(set_of[later]); }
            });
        }
    };
    std::vector<std::uint32_t> waits_for(count, 0);
    for (std::size_t set = 0; set < count; ++set) {
        for_each_edge(set, [&](std::size_t later) { ++waits_for[later]; });
    }
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (std::size_t set = 0; set < count; ++set) {
        if (!sets[set].empty() && waits_for[set] == 0) { ready.push(set); }
    }
    std::vector<std::vector<std::uint32_t>> clusters;
    while (!ready.empty()) {
        const std::size_t next = ready.top();
        ready.pop();
        for_each_edge(next, [&](std::size_t later) {
            if (--waits_for[later] == 0) { ready.push(later); }
        });
        clusters.push_back(std::move(sets[next]));
    }
    return clusters;
}

std::vector<std::uint32_t> list_of(const OcclusionGraphBuilder& graphs, const ViewCell& node) {
    std::vector<std::uint32_t> list;
    for (const auto& set : component_sets(graphs, node)) { list.insert(list.end(), set.begin(), set.end()); }
    return list;
}

// Splitting of polygons that hide one another in a cycle: E. K. Kim, J. A. Park, C. Song, J. H. Kim, 1989, section IV
// and figure 14.
//
// Deviations: the paper splits polygons that pass through one another (split.cpp does that); here the same cut serves
// polygons that overlap cyclically, such as three bars each over the next. Which one to split is not in the paper.

namespace {

/// The occlusion graph among the polygons of a persistent cycle, for its eye or for its region.
OcclusionGraph graph_of(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle) {
    const auto& among = persistent_cycle.polygons;
    OcclusionGraph pairs(graphs.model().faces.size());
    for (const std::uint32_t a : among) {
        for (const std::uint32_t b : among) {
            if (a != b && !graphs.model().ignored.occludes(b, a)) { pairs.add(b, a); }
        }
    }
    return persistent_cycle.eye ? graphs.at_eye(*persistent_cycle.eye, pairs, among)
                                : graphs.surviving(persistent_cycle.region, pairs, among);
}

/// A polygon to split, and the polygon in whose plane it is cut.
struct PolygonCut {
    std::uint32_t polygon = 0;
    std::uint32_t cut_by = 0;
};

/// Whether a face reaches more than `margin` to both sides of a plane.
bool straddles(const Face& face, const Plane& plane, double margin) {
    const auto heights = [&](const glm::dvec3& corner) { return distance_m(plane, corner); };
    const auto [least, most] = std::ranges::minmax(face.outline, {}, heights);
    return heights(least) < -margin && heights(most) > margin;
}

/// The number of cyclic edges among the cycle's polygons once one of them has been cut.
std::size_t left_after(const ModelFaces& model, const PersistentCycle& persistent_cycle,
    const std::vector<std::uint32_t>& cycle, const PolygonCut& cut) {
    const Plane plane = *model.faces[cut.cut_by].plane;
    const Face& whole = model.faces[cut.polygon];
    const std::size_t count = cycle.size() + 1;
    ModelFaces pieces{.faces = {},
        .tolerances = model.tolerances,
        .rigid = OcclusionGraph(count),
        .ignored = OcclusionGraph(count),
        .notes = {}};
    for (const std::uint32_t polygon : cycle) {
        pieces.faces.push_back(polygon == cut.polygon
                                   ? outline_face(front_part(whole.outline, plane, model.tolerances.inset),
                                         *whole.plane, model.tolerances.inset)
                                   : model.faces[polygon]);
    }
    pieces.faces.push_back(outline_face(
        front_part(whole.outline, turned_over(plane), model.tolerances.inset), *whole.plane, model.tolerances.inset));
    PersistentCycle among{std::vector<std::uint32_t>(count), persistent_cycle.region, persistent_cycle.eye};
    std::iota(among.polygons.begin(), among.polygons.end(), 0U);
    OcclusionGraphBuilder graphs(pieces);
    return cyclic_part_of(graph_of(graphs, among)).edges;
}

/// The cut that resolves most of a shortest cycle in a persistent cycle. Of all pairs of the cycle in which one polygon
/// straddles the plane of the other, it is the cut that leaves the fewest cyclic edges, and the lowest polygon numbers
/// among equals. Returns nothing when there is no such pair. That happens only with turning polygons in the cycle,
/// because fixed ones lack an order only if one of them straddles the plane of another, or where the tolerances of two
/// tests differ.
std::optional<PolygonCut> best_polygon_cut(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle) {
    const ModelFaces& model = graphs.model();
    std::vector<std::uint32_t> cycle = shortest_cycle(graph_of(graphs, persistent_cycle), persistent_cycle.polygons);
    std::ranges::sort(cycle);
    std::optional<PolygonCut> best;
    std::size_t fewest = 0;
    for (const std::uint32_t polygon : cycle) {
        for (const std::uint32_t cut_by : cycle) {
            const Face& face = model.faces[polygon];
            const auto& plane = model.faces[cut_by].plane;
            if (face.pivot || !plane || !straddles(face, *plane, 2.0 * model.tolerances.inset)) { continue; }
            const std::size_t left = left_after(model, persistent_cycle, cycle, {polygon, cut_by});
            if (!best || left < fewest) {
                best = PolygonCut{polygon, cut_by};
                fewest = left;
            }
        }
    }
    return best;
}

/// The first pair with a turning polygon of a shortest cycle in a persistent cycle. Returns nothing where no polygon of
/// the cycle turns, or where rounding has left no cycle.
std::optional<Precedence> pair_to_drop(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle) {
    const auto cycle = shortest_cycle(graph_of(graphs, persistent_cycle), persistent_cycle.polygons);
    const auto& faces = graphs.model().faces;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
        const std::uint32_t next = cycle[(i + 1) % cycle.size()];
        if (faces[cycle[i]].pivot || faces[next].pivot) { return Precedence{cycle[i], next}; }
    }
    return std::nullopt;
}

/// A piece overlaps no more polygons of its plane than the whole did, and often fewer.
void end_overlaps(ModelFaces& faces, std::size_t piece) {
    const Face& face = faces.faces[piece];
    for (std::size_t other = 0; other < faces.faces.size(); ++other) {
        if (!overlap_in_plane(face, faces.faces[other], faces.tolerances.inset)) {
            faces.rigid.remove(piece, other);
            faces.rigid.remove(other, piece);
        }
    }
}

/// A model that needs more than 100 + 2 splits a polygon is not suited to painting orders.
constexpr std::uint32_t max_splits_a_polygon = 2;
constexpr std::uint32_t splits_always_allowed = 100;

} // namespace

void WorkingModel::resolve(const PersistentCycle& persistent_cycle) {
    OcclusionGraphBuilder graphs(faces);
    if (const auto cut = best_polygon_cut(graphs, persistent_cycle)) {
        if (sibling_pieces.size() > splits_always_allowed + max_splits_a_polygon * first_count) {
            throw SearchGivenUp{fmt::format("cells need more than {} splits", sibling_pieces.size() - 1)};
        }
        // Faces keep the planes of whole polygons. That of a sliver, from its corners, may be any.
        const Plane plane = *faces.faces[cut->cut_by].plane;
        split_polygon(model, cut->polygon, faces.in_model(plane));
        sibling_pieces.push_back(cut->polygon);
        const Face whole = faces.faces[cut->polygon];
        const double inset = faces.tolerances.inset;
        faces.faces[cut->polygon] = outline_face(front_part(whole.outline, plane, inset), *whole.plane, inset);
        const Plane back = turned_over(plane);
        faces.faces.push_back(outline_face(front_part(whole.outline, back, inset), *whole.plane, inset));
        faces.rigid.add_sibling(cut->polygon);
        faces.ignored.add_sibling(cut->polygon);
        end_overlaps(faces, cut->polygon);
        end_overlaps(faces, faces.faces.size() - 1);
        return;
    }
    const auto weakest = pair_to_drop(graphs, persistent_cycle);
    if (!weakest) { throw SearchGivenUp{"polygons hide one another in a cycle that no cut resolves"}; }
    const Precedence pair = *weakest;
    faces.ignored.add(pair.later, pair.first);
    notes.push_back(fmt::format("{} and {} hide one another as they turn; no order is right at every angle",
        model.parts[model.polygons[pair.first].part], model.parts[model.polygons[pair.later].part]));
}

bool WorkingModel::add_new_pieces(ViewCell& node) const {
    const std::size_t before = node.graph.count();
    while (node.graph.count() < faces.faces.size()) {
        node.graph.add_sibling(sibling_pieces[node.graph.count() - first_count]);
    }
    if (node.graph.count() > before) { node.cycles = cyclic_part_of(node.graph); }
    return node.graph.count() > before;
}

void WorkingModel::add_new_pieces(std::vector<std::uint32_t>& list, std::size_t polygons) const {
    insert_cut_pieces(
        list, std::span(sibling_pieces).subspan(polygons - first_count), static_cast<std::uint32_t>(polygons));
}

} // namespace octant::visuals::draworder
