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

/// The polygons of a node that face some eye of it, as sets that are painted one after the other, the lowest number
/// first where there is a choice: those that hide one another in a cycle are one set, ascending; others are sets of
/// one.
std::vector<std::vector<std::uint32_t>> component_sets(const OcclusionGraphBuilder& graphs, const ViewCell& node);

/// The painting order of a node without cycles: its component_sets(), which are single polygons, in one list.
std::vector<std::uint32_t> list_of(const OcclusionGraphBuilder& graphs, const ViewCell& node);

/// A model that may still be split while its orders are being found, with its faces.
///
/// What was found before a split stays right after it: each piece hides no more than the whole polygon did and is
/// hidden by no more, and the pieces, lying in one plane, do not hide one another. So in a finished list the new piece
/// goes directly behind its twin, and in an unfinished graph it gets its twin's edges until they are tested again.
struct WorkingModel {
    WorkingModel(models::polygons::PolygonModel of, const glm::dvec3& origin_m)
        : model(std::move(of)), faces(model_faces(model, origin_m)),
          first_count(static_cast<std::uint32_t>(model.polygons.size())), notes(faces.notes) {}

    /// Splits a polygon of a shortest cycle in a persistent cycle along the plane of another one, so that the fewest
    /// cyclic edges are left. Turning polygons are not split: where only they are in the way, a pair is given up, with
    /// a note. Throws SearchGivenUp when there is nothing to split, or when a model has been split beyond what is
    /// sensible.
    void resolve(const PersistentCycle& persistent_cycle);

    /// Counts work of the search, if there is a budget; throws SearchGivenUp when it is spent.
    void spend(std::uint64_t units) const {
        if (budget != nullptr) { budget->spend(units); }
    }

    /// Adds to a node the pieces that were split off since it was made. Returns whether there were any.
    bool add_new_pieces(ViewCell& node) const;

    /// Adds such pieces to a list that was made when there were `polygons` polygons.
    void add_new_pieces(std::vector<std::uint32_t>& list, std::size_t polygons) const;

    models::polygons::PolygonModel model;
    ModelFaces faces;
    std::uint32_t first_count = 0;
    /// For polygon first_count + i the polygon whose other piece it is.
    std::vector<std::uint32_t> sibling_pieces;
    std::vector<std::string> notes;
    SearchBudget* budget = nullptr;
};

} // namespace octant::visuals::draworder
