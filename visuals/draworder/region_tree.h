#pragma once

#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/eye_region.h"
#include "visuals/draworder/region_graph.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::draworder {

/// A tree of planes over a region of eye space, the lists and planes of its cells. Planes are in
/// the faces' space.
struct RegionTree {
    std::vector<DrawOrder::Node> nodes; ///< node 0 first, children behind their parents
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<std::vector<Plane>> cell_planes;
};

/// Polygons for which there is no order, wherever eye space is cut: they hide one another in a ring
/// from one eye point, or from all of a region that no plane makes simpler.
struct Deadlock {
    std::vector<std::uint32_t> polygons;
    std::optional<glm::dvec3> eye; ///< in the faces' space
};

/// How a tree is looked for.
struct TreeSearch {
    double power = 1.0;              ///< a graph with E cyclic edges is taken to cost E^power
    std::size_t exact = 16;          ///< planes of which both sides are tested exactly
    std::vector<std::size_t> widths; ///< how many planes are followed up at depth 0, 1, ...; then 1
};

/// A tree whose cells have no cycles. `graph`: RegionGraphs::all of the region.
struct TreeResult {
    RegionTree tree;
    std::optional<Deadlock> deadlock; ///< then the tree is not complete
};

/// Throws Error when the tree grows beyond what can be held.
TreeResult region_tree(
    RegionGraphs& graphs,
    const EyeRegion& region,
    const HidingGraph& graph,
    const TreeSearch& search);

} // namespace octant::visuals::draworder
