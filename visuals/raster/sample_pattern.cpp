#include "visuals/raster/sample_pattern.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>

namespace octant::visuals::raster {

namespace {

std::int32_t reversed_bits(std::int32_t four_bits) {
    return (four_bits & 1) << 3 | (four_bits & 2) << 1 | (four_bits & 4) >> 1 |
           (four_bits & 8) >> 3;
}

} // namespace

SamplePattern sample_pattern(int samples) {
    assert(samples == 1 || samples == 4 || samples == 16);
    constexpr std::array<std::int32_t, 4> four_x{-4, 12, -12, 4};
    constexpr std::array<std::int32_t, 4> four_y{-12, -4, 4, 12};
    SamplePattern pattern;
    for (std::int32_t lane = 0; lane < SamplePattern::lanes; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        if (samples == 16) {
            pattern.x[i] = 2 * reversed_bits(lane) - 15;
            pattern.y[i] = 2 * lane - 15;
        } else if (samples == 4) {
            pattern.x[i] = four_x[i / 4];
            pattern.y[i] = four_y[i / 4];
        }
        pattern.reach = std::max({pattern.reach, std::abs(pattern.x[i]), std::abs(pattern.y[i])});
    }
    return pattern;
}

} // namespace octant::visuals::raster
