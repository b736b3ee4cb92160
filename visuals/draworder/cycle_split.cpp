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
HidingGraph graph_of(RegionGraphs& graphs, const Deadlock& deadlock) {
    const auto& among = deadlock.polygons;
    HidingGraph pairs(graphs.model().faces.size());
    for (const std::uint32_t a : among) {
        for (const std::uint32_t b : among) {
            if (a != b && !graphs.model().ignored.hides(b, a)) {
                pairs.add(b, a);
            }
        }
    }
    return deadlock.eye ? graphs.at_eye(*deadlock.eye, pairs, among)
                        : graphs.surviving(deadlock.region, pairs, among);
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
    const Deadlock& deadlock,
    const std::vector<std::uint32_t>& ring,
    const Cut& cut) {
    const Plane plane = *model.faces[cut.along].plane;
    const Face& whole = model.faces[cut.polygon];
    const std::size_t count = ring.size() + 1;
    ModelFaces pieces{
        .faces = {},
        .tolerances = model.tolerances,
        .rigid = HidingGraph(count),
        .ignored = HidingGraph(count),
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
    Deadlock among{std::vector<std::uint32_t>(count), deadlock.region, deadlock.eye};
    std::iota(among.polygons.begin(), among.polygons.end(), 0U);
    RegionGraphs graphs(pieces);
    return cycles_of(graph_of(graphs, among)).edges;
}

} // namespace

std::optional<Cut> best_cut(RegionGraphs& graphs, const Deadlock& deadlock) {
    const ModelFaces& model = graphs.model();
    std::vector<std::uint32_t> ring = shortest_ring(graph_of(graphs, deadlock), deadlock.polygons);
    std::ranges::sort(ring);
    std::optional<Cut> best;
    std::size_t fewest = 0;
    for (const std::uint32_t polygon : ring) {
        for (const std::uint32_t along : ring) {
            const Face& face = model.faces[polygon];
            const auto& plane = model.faces[along].plane;
            if (face.pivot || !plane || !straddles(face, *plane, 2.0 * model.tolerances.inset)) {
                continue;
            }
            const std::size_t left = left_after(model, deadlock, ring, {polygon, along});
            if (!best || left < fewest) {
                best = Cut{polygon, along};
                fewest = left;
            }
        }
    }
    return best;
}

std::optional<Precedence> weakest_pair(RegionGraphs& graphs, const Deadlock& deadlock) {
    const auto ring = shortest_ring(graph_of(graphs, deadlock), deadlock.polygons);
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
