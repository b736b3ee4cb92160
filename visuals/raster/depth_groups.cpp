#include "visuals/raster/depth_groups.h"

#include <algorithm>
#include <cstddef>

namespace octant::visuals::raster {

std::vector<std::uint16_t> depth_groups(std::span<const scene::PaintStep> steps) {
    using scene::PaintStep;
    std::vector<std::uint16_t> groups(steps.size(), 0);
    std::uint16_t group = 1;
    std::size_t last = steps.size(); // that used this group's depth; none yet
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].content == PaintStep::Content::ClearDepth) {
            ++group;
            last = steps.size();
        } else if (steps[i].depth != scene::DepthUse::None) {
            const std::size_t from = last == steps.size() ? i : last + 1;
            std::fill(
                groups.begin() + static_cast<std::ptrdiff_t>(from),
                groups.begin() + static_cast<std::ptrdiff_t>(i + 1),
                group);
            last = i;
        }
    }
    return groups;
}

} // namespace octant::visuals::raster
