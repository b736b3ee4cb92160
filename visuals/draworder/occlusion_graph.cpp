#include "visuals/draworder/occlusion_graph.h"

#include <algorithm>
#include <utility>

namespace octant::visuals::draworder {

void OcclusionGraph::add_sibling(std::size_t polygon) {
    OcclusionGraph bigger(count_ + 1);
    for (std::size_t a = 0; a <= count_; ++a) {
        const std::size_t as = a < count_ ? a : polygon;
        std::ranges::copy(row(as), bigger.row(a).begin());
        if (occludes(polygon, as)) { bigger.add(count_, a); }
    }
    *this = std::move(bigger);
}

std::vector<Precedence> OcclusionGraph::precedences(const PolygonSet& among) const {
    std::vector<Precedence> pairs;
    for_each_bit(among.words(), [&](std::size_t a) {
        for_each_bit(row(a), [&](std::size_t b) {
            if (among.has(b)) { pairs.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)}); }
        });
    });
    return pairs;
}

} // namespace octant::visuals::draworder
