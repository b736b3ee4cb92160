#pragma once

#include "visuals/draworder/eye_node.h"
#include "visuals/draworder/precedence.h"
#include "visuals/draworder/region_graph.h"

#include <cstdint>
#include <optional>

namespace octant::visuals::draworder {

/// A polygon to cut, and the polygon along whose plane.
struct Cut {
    std::uint32_t polygon = 0;
    std::uint32_t along = 0;
};

/// The cut that ends most of a shortest ring of a deadlock: of all pairs of the ring of which one
/// lies on both sides of the other's plane, the one that leaves the fewest pairs on rings, the
/// lowest numbers among equals. Turning polygons are not cut. Nothing when there is no such pair,
/// which takes turning polygons in the ring: those without any have no order only if one of them
/// straddles the plane of another.
std::optional<Cut> best_cut(RegionGraphs& graphs, const Deadlock& deadlock);

/// A pair of a shortest ring of a deadlock, for which no order is right: rather one with a turning
/// polygon.
Precedence weakest_pair(RegionGraphs& graphs, const Deadlock& deadlock);

} // namespace octant::visuals::draworder
