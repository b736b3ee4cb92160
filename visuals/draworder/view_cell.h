#pragma once

#include "visuals/draworder/components.h"
#include "visuals/draworder/occlusion_graph_builder.h"
#include "visuals/draworder/view_region.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::draworder {

/// A region of eye space and the hiding graph for the eyes in it.
struct ViewCell {
    ViewRegion region;
    OcclusionGraph graph;
    CyclicPart cycles; ///< The cyclic part of the graph; without it the region has a painting order.
};

/// The node of a region, with all pairs of polygons tested.
ViewCell view_cell(OcclusionGraphBuilder& graphs, const ViewRegion& region);

/// The node of a part of a node's region. Only edges on cycles are tested again; the others stay as they are, because
/// they have an order already and do no harm. `sides` tells where the polygons lie to a plane that the part is in front
/// of; null when there is none.
ViewCell part_of(
    OcclusionGraphBuilder& graphs, const ViewCell& node, ViewRegion part, const PlaneSideSets* sides = nullptr);

/// About the work of testing a node's cyclic edges (SearchBudget).
std::uint64_t search_units(const ViewCell& node);

/// Polygons that have no painting order however eye space is cut: they hide one another in a ring from a single eye
/// point, or in all of a region that no plane makes simpler.
struct PersistentCycle {
    std::vector<std::uint32_t> polygons; ///< One strongly connected component.
    ViewRegion region;
    std::optional<glm::dvec3> eye; ///< In the faces' space; nothing = all of the region.
};

/// The ring that an eye in the middle of the region sees, if there is one.
std::optional<PersistentCycle> cycle_at_eye(OcclusionGraphBuilder& graphs, const ViewCell& node);

/// Throws SearchGivenUp when lists have more entries than can be held.
void check_entries(std::size_t entries);

/// The painting order of a node without cycles: the polygons that face some eye of it, first painted first, and the
/// lowest number first where there is a choice.
std::vector<std::uint32_t> list_of(const OcclusionGraphBuilder& graphs, const ViewCell& node);

/// The polygons of a node with cycles that face some eye of it, as sets that are painted one after the other: those
/// that hide one another in a ring are one set, ascending; others stand alone.
std::vector<std::vector<std::uint32_t>> component_sets(const OcclusionGraphBuilder& graphs, const ViewCell& node);

} // namespace octant::visuals::draworder
