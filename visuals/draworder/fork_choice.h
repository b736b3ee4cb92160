#pragma once

#include "sim/base/plane.h"
#include "visuals/draworder/eye_node.h"
#include "visuals/draworder/working_model.h"

#include <cstddef>
#include <optional>

namespace octant::visuals::draworder {

/// How thoroughly a plane is searched for.
struct ForkSearch {
    /// A graph with E cyclic edges is taken to cost E^power.
    double power = 1.0;
    /// About how many planes through an edge and a corner are tried.
    std::size_t edge_planes = 8000;
    /// For so many planes the edges left on cycles are counted.
    std::size_t closer = 400;
    /// For so many planes both sides are tested exactly.
    std::size_t exact = 48;
    /// Whether planes across the axes are tried first. A model that is turned then gets others.
    bool by_axes = false;
};

/// A node that was divided by a plane.
struct Fork {
    Plane plane;
    EyeNode front;
    EyeNode back;
};

/// The plane that leaves a node simplest, with the node divided by it; nothing when no plane makes
/// the node simpler. Throws SearchGivenUp (search_budget.h) when a budget is spent.
std::optional<Fork>
best_fork(const WorkingModel& work, const EyeNode& node, const ForkSearch& search);

} // namespace octant::visuals::draworder
