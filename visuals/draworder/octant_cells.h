#pragma once

#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/working_model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// The octants about the faces' origin, each divided until its cells have orders. Planes are in the
/// faces' space.
struct OctantCells {
    std::vector<DrawOrder::Node> nodes; ///< Node 0 is the root; children come after their parents.
    std::vector<std::vector<std::uint32_t>> lists;
    /// Such as "+-+/0/3"; cells that were divided by planes share one.
    std::vector<std::string> paths;
    std::vector<std::vector<Plane>> cell_planes; ///< Without the plane of the least distance.
};

/// Section IV of the 1989 paper: "divide the viewing directions further until all hidden surfaces
/// are removed". The lists are right for eyes with |x| + |y| + |z| >= min_distance from the
/// origin.
///
/// Octant "sx sy sz" is the flat triangle A = (sx, 0, 0), B = (0, sy, 0), C = (0, 0, sz) as seen
/// from the origin. Where its graph has a cycle it is divided at the midpoints of its sides into 0
/// = (A, AB, CA), 1 = (AB, B, BC), 2 = (CA, BC, C), 3 = (BC, CA, AB). A quarter that is still
/// cyclic is divided by planes as in view_space_tree.h: cones about one centre cannot approximate a
/// plane that misses the centre, however fine they are, and each further level of them makes more
/// cells than it saves.
///
/// Splits polygons of the model where there is no order otherwise. Throws SearchGivenUp
/// (search_budget.h) when there are more cells than can be held, or when a budget is spent.
OctantCells octant_cells(WorkingModel& work, double min_distance);

} // namespace octant::visuals::draworder
