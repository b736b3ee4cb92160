#pragma once

#include "sim/base/plane.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/working_model.h"

#include <cstddef>
#include <optional>

namespace octant::visuals::draworder {

/// How thoroughly a plane is searched for.
struct SplitPlaneSearch {
    /// A graph with E cyclic edges is taken to cost E^power.
    double power = 1.0;
    /// About how many planes through an edge and a corner are tried.
    std::size_t edge_planes = 8000;
    /// For so many planes the edges left on cycles are counted.
    std::size_t coarse_candidates = 400;
    /// For so many planes both sides are tested exactly.
    std::size_t exact = 48;
    /// Whether planes across the axes are tried first. A model that is turned then gets others.
    bool tries_axis_planes_first = false;
};

/// A node that was divided by a plane.
struct CellSplit {
    Plane plane;
    ViewCell front;
    ViewCell back;
};

/// The plane that leaves a node simplest, with the node divided by it; nothing when no plane makes
/// the node simpler. Throws SearchGivenUp (search_budget.h) when a budget is spent.
std::optional<CellSplit>
best_split(const WorkingModel& work, const ViewCell& node, const SplitPlaneSearch& search);

} // namespace octant::visuals::draworder
