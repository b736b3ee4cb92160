#pragma once

#include "visuals/draworder/components.h"
#include "visuals/draworder/eye_region.h"
#include "visuals/draworder/region_graph.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::draworder {

/// A region of eye space with what hides what from there.
struct EyeNode {
    EyeRegion region;
    HidingGraph graph;
    Cycles cycles; ///< of the graph
};

/// All pairs are tested.
EyeNode eye_node(RegionGraphs& graphs, const EyeRegion& region);

/// A part of a node's region. Only pairs on rings are tested again: the others order what no ring
/// joins, and do no harm. `sides`: of a plane that the part lies in front of; null for none.
EyeNode
part_of(RegionGraphs& graphs, const EyeNode& node, EyeRegion part, const SideSets* sides = nullptr);

/// Polygons for which there is no order, wherever eye space is cut: they hide one another in a ring
/// from one eye point, or from all of a region that no plane makes simpler.
struct Deadlock {
    std::vector<std::uint32_t> polygons; ///< one component of the graph
    EyeRegion region;
    std::optional<glm::dvec3> eye; ///< in the faces' space; none: all of the region
};

/// The ring that an eye in the middle of the region meets, if it does.
std::optional<Deadlock> ring_at_eye(RegionGraphs& graphs, const EyeNode& node);

/// Throws Error when the lists of a model of so many polygons have more entries than can be held.
void check_entries(std::size_t entries, std::size_t polygons);

/// The list of a node without cycles: the polygons that face some eye of it, first painted first.
std::vector<std::uint32_t> list_of(const RegionGraphs& graphs, const EyeNode& node);

} // namespace octant::visuals::draworder
