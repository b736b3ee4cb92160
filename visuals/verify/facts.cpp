#include "visuals/verify/facts.h"

#include <algorithm>
#include <cassert>

namespace octant::visuals::verify {

Bits& Facts::row(std::uint32_t later) {
    return rows_.try_emplace(later, polygons_).first->second;
}

void Facts::add(const Pair& pair) {
    row(pair.later).add(pair.earlier);
}

void Facts::add_wall(const WrittenPlane& wall, const Certificate& certificate, const Sides& sides) {
    const WrittenPlane back = reversed(wall);
    Bits behind(polygons_);
    for (std::uint32_t i = 0; i < polygons_; ++i) {
        if (sides.is_behind(i, wall, Pose::Turning)) {
            behind.add(i);
        }
    }
    for (std::uint32_t i = 0; i < polygons_; ++i) {
        if (!sides.is_behind(i, back, Pose::Turning)) {
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

bool Facts::decide(const Bits& painted, std::uint32_t later) const {
    const auto known = rows_.find(later);
    return known != rows_.end() && painted.within(known->second);
}

std::uint32_t Facts::first_open(std::span<const std::uint32_t> painted, std::uint32_t later) const {
    const auto known = rows_.find(later);
    const auto open = std::ranges::find_if(painted, [&](std::uint32_t earlier) {
        return known == rows_.end() || !known->second.has(earlier);
    });
    assert(open != painted.end());
    return *open;
}

} // namespace octant::visuals::verify
