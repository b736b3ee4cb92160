#include "visuals/verify/proved_pairs.h"

#include <algorithm>
#include <cassert>

namespace octant::visuals::verify {

PolygonSet& ProvedPairs::row(std::uint32_t later) {
    return rows_.try_emplace(later, polygons_).first->second;
}

void ProvedPairs::add(const PolygonPair& pair) {
    row(pair.later).add(pair.earlier);
}

void ProvedPairs::add_region_plane(const WrittenPlane& wall, const Certificate& certificate, const ExactSides& sides) {
    const WrittenPlane back = reversed(wall);
    PolygonSet behind(polygons_);
    for (std::uint32_t i = 0; i < polygons_; ++i) {
        if (sides.is_behind(i, wall, PartAngle::Turning)) {
            behind.add(i);
        }
    }
    for (std::uint32_t i = 0; i < polygons_; ++i) {
        if (!sides.is_behind(i, back, PartAngle::Turning)) {
            continue;
        }
        // Polygons that turn together see the wall turn.
        const auto& axis = certificate.polygons[i].axis;
        if (!axis) {
            row(i).add(behind);
            continue;
        }
        for (std::uint32_t earlier = 0; earlier < polygons_; ++earlier) {
            if (behind.has(earlier) && certificate.polygons[earlier].axis != axis) {
                row(i).add(earlier);
            }
        }
    }
}

bool ProvedPairs::decide(const PolygonSet& painted, std::uint32_t later) const {
    const auto known = rows_.find(later);
    return known != rows_.end() && painted.is_subset_of(known->second);
}

std::uint32_t ProvedPairs::first_open(std::span<const std::uint32_t> painted, std::uint32_t later) const {
    const auto known = rows_.find(later);
    const auto open = std::ranges::find_if(painted, [&](std::uint32_t earlier) {
        return known == rows_.end() || !known->second.has(earlier);
    });
    assert(open != painted.end());
    return *open;
}

} // namespace octant::visuals::verify
