#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/model_faces.h"
#include "visuals/draworder/occlusion_graph_builder.h"
#include "visuals/draworder/precedence.h"
#include "visuals/draworder/search_budget.h"
#include "visuals/draworder/view_cell.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

/// A polygon to split, and the polygon in whose plane it is cut.
struct PolygonCut {
    std::uint32_t polygon = 0;
    std::uint32_t cut_by = 0;
};

/// The cut that resolves most of a shortest ring of a deadlock. Of all pairs of the ring in which one polygon straddles
/// the plane of the other, it is the cut that leaves the fewest cyclic edges, and the lowest polygon numbers among
/// equals. Turning polygons are not cut. Returns nothing when there is no such pair. That happens only with turning
/// polygons in the ring, because fixed ones lack an order only if one of them straddles the plane of another, or where
/// the tolerances of two tests differ.
std::optional<PolygonCut> best_polygon_cut(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle);

/// The first pair with a turning polygon of a shortest ring of a deadlock: it is given up because no order can be
/// right. Returns nothing where no polygon of the ring turns, or where rounding has left no ring.
std::optional<Precedence> pair_to_drop(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle);

/// A model that may still be split while its orders are being found, with its faces.
///
/// What was found before a split stays right after it: each piece hides no more than the whole polygon did and is
/// hidden by no more, and the pieces, lying in one plane, do not hide one another. So in a finished list the new piece
/// goes directly behind its twin, and in an unfinished graph it gets its twin's edges until they are tested again.
struct WorkingModel {
    WorkingModel(models::polygons::PolygonModel of, const glm::dvec3& origin_m)
        : model(std::move(of)), faces(model_faces(model, origin_m)),
          first_count(static_cast<std::uint32_t>(model.polygons.size())), notes(faces.notes) {}

    /// Splits a polygon of a deadlock, or gives up a pair where only turning polygons are in the way. Throws
    /// SearchGivenUp when there is nothing to split, or when a model has been split beyond what is sensible.
    void resolve(const PersistentCycle& persistent_cycle);

    /// Counts work of the search, if there is a budget; throws SearchGivenUp when it is spent.
    void spend(std::uint64_t units) const {
        if (budget != nullptr) { budget->spend(units); }
    }

    /// Adds to a node the pieces that were split off since it was made. Returns whether there were any.
    bool add_new_pieces(ViewCell& node) const;

    /// Adds such pieces to a list that was made when there were `polygons` polygons.
    void add_new_pieces(std::vector<std::uint32_t>& list, std::size_t polygons) const;

    void end_overlaps(std::size_t piece);

    models::polygons::PolygonModel model;
    ModelFaces faces;
    std::uint32_t first_count = 0;
    /// For polygon first_count + i the polygon whose other piece it is.
    std::vector<std::uint32_t> sibling_pieces;
    std::vector<std::string> notes;
    SearchBudget* budget = nullptr;
};

} // namespace octant::visuals::draworder
