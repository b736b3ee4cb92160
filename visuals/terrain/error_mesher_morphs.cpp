// When a vertex has to be at its own sample: before those samples appear that need it, as the
// beginning of error_mesher.cpp tells.
#include "visuals/terrain/error_mesher.h"

#include <algorithm>
#include <limits>

namespace octant::visuals::terrain {

/// The least critical value of the centres around the middle of an edge. A node beyond it that the
/// view does not see is looked up, so that the weight is the same whichever way the view is turned.
float ErrorMesher::least_below_middle(const EmittedFan& fan, std::size_t edge) const {
    const ErrorNode& node = nodes_[fan.node];
    if (node.level + 1 == ground_->levels()) {
        return std::numeric_limits<float>::infinity();
    }
    const FanEdge& side = fan_edges[edge];
    const float least = std::min(node.quadrant[side.quadrant_a], node.quadrant[side.quadrant_b]);
    const unsigned across = side.beyond_east != 0 ? 1U : 2U;
    const auto with = [&](const FourFloats& beyond) {
        return std::min(
            {least, beyond[side.quadrant_a ^ across], beyond[side.quadrant_b ^ across]});
    };
    if (fan.beyond[edge] != 0) {
        return with(nodes_[fan.beyond[edge]].quadrant);
    }
    const int column = node.column + side.beyond_east;
    const int row = node.row + side.beyond_north;
    const LevelMemory& memory = rule_.memory(node.level);
    const bool in_field =
        column >= 0 && row >= 0 && column < memory.columns() && row < memory.rows();
    return in_field ? with(rule_.criticals_at(node.level, column, row).quadrant) : least;
}

} // namespace octant::visuals::terrain
