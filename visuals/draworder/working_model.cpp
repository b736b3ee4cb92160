// The last resort of both exact methods: where no division of eye space gives an order, a polygon
// is split (section IV and figure 14 of the 1989 paper), and all that was found before is kept up
// to date.
#include "visuals/draworder/working_model.h"

#include "sim/base/plane.h"
#include "visuals/draworder/cut_pieces.h"
#include "visuals/draworder/cycle_split.h"
#include "visuals/draworder/split.h"

#include <fmt/format.h>
#include <span>
#include <utility>

namespace octant::visuals::draworder {

namespace {

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
        faces.faces[cut->polygon] =
            outline_face(front_part(whole.outline, plane, inset), *whole.plane, inset);
        const Plane back = turned_over(plane);
        faces.faces.push_back(
            outline_face(front_part(whole.outline, back, inset), *whole.plane, inset));
        faces.rigid.add_sibling(cut->polygon);
        faces.ignored.add_sibling(cut->polygon);
        end_overlaps(cut->polygon);
        end_overlaps(faces.faces.size() - 1);
        return;
    }
    const auto weakest = pair_to_drop(graphs, persistent_cycle);
    if (!weakest) {
        throw SearchGivenUp{"polygons hide one another in a ring that no cut resolves"};
    }
    const Precedence pair = *weakest;
    faces.ignored.add(pair.later, pair.first);
    notes.push_back(fmt::format(
        "{} and {} hide one another as they turn; no order is right at every angle",
        model.parts[model.polygons[pair.first].part],
        model.parts[model.polygons[pair.later].part]));
}

/// A piece overlaps no more polygons of its plane than the whole did, and often fewer.
void WorkingModel::end_overlaps(std::size_t piece) {
    const Face& face = faces.faces[piece];
    for (std::size_t other = 0; other < faces.faces.size(); ++other) {
        if (!overlap_in_plane(face, faces.faces[other], faces.tolerances.inset)) {
            faces.rigid.remove(piece, other);
            faces.rigid.remove(other, piece);
        }
    }
}

bool WorkingModel::add_new_pieces(ViewCell& node) const {
    const std::size_t before = node.graph.count();
    while (node.graph.count() < faces.faces.size()) {
        node.graph.add_sibling(sibling_pieces[node.graph.count() - first_count]);
    }
    if (node.graph.count() > before) {
        node.cycles = cyclic_part_of(node.graph);
    }
    return node.graph.count() > before;
}

void WorkingModel::add_new_pieces(std::vector<std::uint32_t>& list, std::size_t polygons) const {
    insert_cut_pieces(
        list,
        std::span(sibling_pieces).subspan(polygons - first_count),
        static_cast<std::uint32_t>(polygons));
}

} // namespace octant::visuals::draworder
