#pragma once

#include "sim/base/plane.h"

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// The eye points that share a list.
struct OrderCell {
    std::string path; ///< Paper, Cells: "+-+/0/3"; empty for a cell of a tree.
    /// The cell is the intersection of the half-spaces in front of them; unit normals, body axes.
    std::vector<Plane> planes;
};

} // namespace octant::visuals::draworder
