#include "visuals/terrain/vertical_distances.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace octant::visuals::terrain {

namespace {

constexpr float no_end = std::numeric_limits<float>::infinity();

/// A number of a block and its neighbours, row after row from the south-west.
using NineBlocks = std::array<float, 9>;

/// The least of the block's own number and those of neighbours, indexed as VerticalDistances::squared_m2.
std::array<float, 16> min_by_reach(const NineBlocks& of) {
    std::array<float, 16> least{};
    for (unsigned reach = 0; reach < 16; ++reach) {
        const int west = (reach & 1U) != 0 ? 0 : 1;
        const int east = (reach & 2U) != 0 ? 2 : 1;
        const int south = (reach & 4U) != 0 ? 0 : 1;
        const int north = (reach & 8U) != 0 ? 2 : 1;
        least[reach] = no_end;
        for (int row = south; row <= north; ++row) {
            for (int column = west; column <= east; ++column) {
                least[reach] =
                    std::min(least[reach], of[static_cast<std::size_t>(3 * row + column)]);
            }
        }
    }
    return least;
}

} // namespace

VerticalDistances vertical_distances(const GroundTiles& ground, const BlockIndex& block, const EyeElevation& eye) {
    const int level = block.level;
    const GroundLayout::Level& of_level = ground.layout().level(level);
    NineBlocks gap{};
    NineBlocks ahead{};
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const int c = block.column + i - 1;
            const int r = block.row + j - 1;
            const auto to = static_cast<std::size_t>(3 * j + i);
            gap[to] = no_end;
            ahead[to] = no_end;
            if (c >= 0 && r >= 0 && c < of_level.columns && r < of_level.rows) {
                const float low = ground.lowest_m(level, c, r) - eye.z_m;
                const float high = ground.highest_m(level, c, r) - eye.z_m;
                const float off = std::max({low, -high, 0.0F});
                gap[to] = off * off;
                ahead[to] = eye.ahead_up * (eye.ahead_up > 0.0F ? low : high);
            }
        }
    }
    VerticalDistances distances;
    distances.lowest_m = ground.lowest_m(level, block.column, block.row);
    distances.highest_m = ground.highest_m(level, block.column, block.row);
    distances.squared_m2 = min_by_reach(gap);
    distances.ahead_m = min_by_reach(ahead);
    return distances;
}

} // namespace octant::visuals::terrain
