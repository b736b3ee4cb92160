#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/search_budget.h"
#include "visuals/draworder/view_region.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

/// A region of eye space and the occlusion graph for the eyes in it.
struct ViewCell {
    ViewRegion region;
    OcclusionGraph graph;
    CyclicPart cycles; ///< The cyclic part of the graph; without it the region has a painting order.
};

/// The node of a region, with all pairs of polygons tested.
ViewCell view_cell(OcclusionGraphBuilder& graphs, const ViewRegion& region);

/// The node of a part of a node's region. Only edges on cycles are tested again; the others stay as they are, because
/// they have an order already and do no harm. `sides` are the polygons on each side of a plane that the part is in
/// front of; null when there is none.
ViewCell part_of(
    OcclusionGraphBuilder& graphs, const ViewCell& node, ViewRegion part, const PlaneSideSets* sides = nullptr);

/// About the work of testing a node's cyclic edges (SearchBudget).
std::uint64_t search_units(const ViewCell& node);

/// Polygons that have no painting order however eye space is cut: they hide one another in a cycle from a single eye
/// point, or in all of a region that no plane makes simpler.
struct PersistentCycle {
    std::vector<std::uint32_t> polygons; ///< One strongly connected component.
    ViewRegion region;
    std::optional<glm::dvec3> eye; ///< In the faces' space; nothing = all of the region.
};

/// The cycle that an eye in the middle of the region sees, if there is one.
std::optional<PersistentCycle> cycle_at_eye(OcclusionGraphBuilder& graphs, const ViewCell& node);

/// Throws SearchGivenUp when lists have more entries than can be held.
void check_entries(std::size_t entries);

/// The painting order of a node without cycles: the polygons that face some eye of it, first painted first, and the
/// lowest number first where there is a choice.
std::vector<std::uint32_t> list_of(const OcclusionGraphBuilder& graphs, const ViewCell& node);

/// The polygons of a node with cycles that face some eye of it, as sets that are painted one after the other: those
/// that hide one another in a cycle are one set, ascending; others stand alone.
std::vector<std::vector<std::uint32_t>> component_sets(const OcclusionGraphBuilder& graphs, const ViewCell& node);

/// A polygon to split, and the polygon in whose plane it is cut.
struct PolygonCut {
    std::uint32_t polygon = 0;
    std::uint32_t cut_by = 0;
};

/// The cut that resolves most of a shortest cycle in a persistent cycle. Of all pairs of the cycle in which one polygon
/// straddles the plane of the other, it is the cut that leaves the fewest cyclic edges, and the lowest polygon numbers
/// among equals. Turning polygons are not cut. Returns nothing when there is no such pair. That happens only with
/// turning polygons in the cycle, because fixed ones lack an order only if one of them straddles the plane of another,
/// or where the tolerances of two tests differ.
std::optional<PolygonCut> best_polygon_cut(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle);

/// The first pair with a turning polygon of a shortest cycle in a persistent cycle: it is given up because no order can
/// be right. Returns nothing where no polygon of the cycle turns, or where rounding has left no cycle.
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

    /// Splits a polygon of a persistent cycle, or gives up a pair where only turning polygons are in the way. Throws
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
