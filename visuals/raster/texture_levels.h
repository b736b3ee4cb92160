#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::raster {

/// Which levels of the ground's texture something is coloured by.
struct TextureLevels {
    std::uint16_t fine = 0;
    std::uint16_t coarse_share = 0; ///< of the next level, 2^-16
};

/// The logarithm to base 2 of a number above 0, straight between whole numbers: wrong by less than
/// 0.09.
inline double coarse_log2(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return static_cast<double>(static_cast<std::int64_t>(bits >> 20U)) * 0x1p-32 - 1023.0;
}

/// Levels for pixels that are so many texels of the finest level wide, squared, of a texture of
/// `count` levels. Most pixels take one level: the next one comes in over a third of the way only.
inline TextureLevels levels_of(double size2, std::size_t count) {
    constexpr double band = 1.0 / 3.0;
    if (!(size2 > 1.0)) {
        return {};
    }
    const double level = 0.5 * coarse_log2(size2);
    const auto whole = static_cast<std::size_t>(level);
    if (whole + 1 >= count) {
        return {static_cast<std::uint16_t>(count - 1), 0};
    }
    const double part = level - static_cast<double>(whole);
    const double share = std::clamp((part - 0.5) / band + 0.5, 0.0, 1.0);
    if (share >= 1.0) {
        return {static_cast<std::uint16_t>(whole + 1), 0};
    }
    return {static_cast<std::uint16_t>(whole), static_cast<std::uint16_t>(share * 65535.0)};
}

} // namespace octant::visuals::raster
