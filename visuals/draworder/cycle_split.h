#pragma once

#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/precedence.h"
#include "visuals/draworder/occlusion_graph_builder.h"

#include <cstdint>
#include <optional>

namespace octant::visuals::draworder {

/// A polygon to split, and the polygon in whose plane it is cut.
struct PolygonCut {
    std::uint32_t polygon = 0;
    std::uint32_t cut_by = 0;
};

/// The cut that resolves most of a shortest ring of a deadlock. Of all pairs of the ring in which
/// one polygon straddles the plane of the other, it is the cut that leaves the fewest cyclic edges,
/// and the lowest polygon numbers among equals. Turning polygons are not cut. Returns nothing when
/// there is no such pair. That happens only with turning polygons in the ring, because fixed ones
/// lack an order only if one of them straddles the plane of another, or where the tolerances of two
/// tests differ.
std::optional<PolygonCut> best_polygon_cut(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle);

/// The first pair with a turning polygon of a shortest ring of a deadlock: it is given up because
/// no order can be right. Returns nothing where no polygon of the ring turns, or where rounding has
/// left no ring.
std::optional<Precedence> pair_to_drop(OcclusionGraphBuilder& graphs, const PersistentCycle& persistent_cycle);

} // namespace octant::visuals::draworder
