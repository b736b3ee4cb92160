// Splitting of polygons that hide one another in a ring: E. K. Kim, J. A. Park, C. Song, J. H. Kim,
// 1989, section IV and figure 14.
//
// Deviations: the paper splits polygons that pass through one another (split.cpp does that); here
// the same cut serves polygons that overlap cyclically, such as three bars each over the next.
// Which one to split is not in the paper.
#include "visuals/draworder/cycle_split.h"

#include "sim/base/plane.h"
#include "visuals/draworder/components.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

/// The hiding graph among the polygons of a deadlock, for its eye or for its region.
OcclusionGraph graph_of(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle) {
    const auto& among = persistent_cycle.polygons;
    OcclusionGraph pairs(graphs.model().faces.size());
    for (const std::uint32_t a : among) {
        for (const std::uint32_t b : among) {
            if (a != b && !graphs.model().ignored.occludes(b, a)) {
                pairs.add(b, a);
            }
        }
    }
    return persistent_cycle.eye ? graphs.at_eye(*persistent_cycle.eye, pairs, among)
                        : graphs.surviving(persistent_cycle.region, pairs, among);
}

/// Whether a face reaches more than `margin` to both sides of a plane.
bool straddles(const Face& face, const Plane& plane, double margin) {
    const auto heights = [&](const glm::dvec3& corner) { return distance_m(plane, corner); };
    const auto [least, most] = std::ranges::minmax(face.outline, {}, heights);
    return heights(least) < -margin && heights(most) > margin;
}

/// The number of cyclic edges among the ring's polygons once one of them has been cut.
std::size_t left_after(
    const ModelFaces& model,
    const PersistentCycle& persistent_cycle,
    const std::vector<std::uint32_t>& ring,
    const PolygonCut& cut) {
    const Plane plane = *model.faces[cut.cut_by].plane;
    const Face& whole = model.faces[cut.polygon];
    const std::size_t count = ring.size() + 1;
    ModelFaces pieces{
        .faces = {},
        .tolerances = model.tolerances,
        .rigid = OcclusionGraph(count),
        .ignored = OcclusionGraph(count),
        .notes = {}};
    for (const std::uint32_t polygon : ring) {
        pieces.faces.push_back(
            polygon == cut.polygon ? outline_face(
                                         front_part(whole.outline, plane, model.tolerances.inset),
                                         *whole.plane,
                                         model.tolerances.inset)
                                   : model.faces[polygon]);
    }
    pieces.faces.push_back(outline_face(
        front_part(whole.outline, turned_over(plane), model.tolerances.inset),
        *whole.plane,
        model.tolerances.inset));
    PersistentCycle among{std::vector<std::uint32_t>(count), persistent_cycle.region, persistent_cycle.eye};
    std::iota(among.polygons.begin(), among.polygons.end(), 0U);
    OcclusionGraphBuilder graphs(pieces);
    return cyclic_part_of(graph_of(graphs, among)).edges;
}

} // namespace

std::optional<PolygonCut> best_polygon_cut(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle) {
    const ModelFaces& model = graphs.model();
    std::vector<std::uint32_t> ring = shortest_cycle(graph_of(graphs, persistent_cycle), persistent_cycle.polygons);
    std::ranges::sort(ring);
    std::optional<PolygonCut> best;
    std::size_t fewest = 0;
    for (const std::uint32_t polygon : ring) {
        for (const std::uint32_t cut_by : ring) {
            const Face& face = model.faces[polygon];
            const auto& plane = model.faces[cut_by].plane;
            if (face.pivot || !plane || !straddles(face, *plane, 2.0 * model.tolerances.inset)) {
                continue;
            }
            const std::size_t left = left_after(model, persistent_cycle, ring, {polygon, cut_by});
            if (!best || left < fewest) {
                best = PolygonCut{polygon, cut_by};
                fewest = left;
            }
        }
    }
    return best;
}

std::optional<Precedence> pair_to_drop(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle) {
    const auto ring = shortest_cycle(graph_of(graphs, persistent_cycle), persistent_cycle.polygons);
    const auto& faces = graphs.model().faces;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t next = ring[(i + 1) % ring.size()];
        if (faces[ring[i]].pivot || faces[next].pivot) {
            return Precedence{ring[i], next};
        }
    }
    return std::nullopt;
}

} // namespace octant::visuals::draworder
