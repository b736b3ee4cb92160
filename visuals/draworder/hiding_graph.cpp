#include "visuals/draworder/hiding_graph.h"

namespace octant::visuals::draworder {

std::vector<Precedence> HidingGraph::precedences(const PolygonSet& among) const {
    std::vector<Precedence> pairs;
    for_each_bit(among.words(), [&](std::size_t a) {
        for_each_bit(row(a), [&](std::size_t b) {
            if (among.has(b)) {
                pairs.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
            }
        });
    });
    return pairs;
}

} // namespace octant::visuals::draworder
