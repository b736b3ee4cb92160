#pragma once

#include "visuals/roads/road_cost_grid.h"

#include <cstddef>
#include <vector>

namespace octant::visuals::roads {

/// Cells that a road goes through, neighbours of the grid or a knight's move apart, from one place
/// where roads end or meet to the next.
using Route = std::vector<std::size_t>;

/// Where people live: the best cell of each block some kilometres wide that has a good one, low in
/// its valley and level, at most a few hundred in all.
std::vector<std::size_t> find_towns(const RoadCostGrid& ground, const RoadConstraints& constraints);

/// Roads between towns that are near each other, each by the cheapest way, as few as join all that
/// can be joined, and some more where the way around would be long. No two run side by side in the
/// same cells: what they share is a route of its own.
std::vector<Route> find_routes(const RoadCostGrid& ground, const std::vector<std::size_t>& towns);

} // namespace octant::visuals::roads
