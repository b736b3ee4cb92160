#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::raster {

/// Which levels of the ground's texture something is coloured by, and how often.
struct MipSelection {
    std::uint16_t fine = 0;
    std::uint16_t coarse_share = 0; ///< of the next level, 2^-16
    std::uint16_t probes = 1;       ///< at even distances along the pixel's longer way
    std::array<float, 2> reach{};   ///< from its middle to the last one, texels of the finest level
};

/// How the place in the texture moves from a pixel to the next ones, texels of the finest level.
struct TexelDerivatives {
    std::array<double, 2> across;
    std::array<double, 2> down;
};

/// The logarithm to base 2 of a number above 0, straight between whole numbers: wrong by less than 0.09.
inline double coarse_log2(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return static_cast<double>(static_cast<std::int64_t>(bits >> 20U)) * 0x1p-32 - 1023.0;
}

/// Levels for pixels that are so many texels of the finest level wide, squared, of a texture of `count` levels. Most
/// pixels take one level: the next one comes in over a third of the way only.
inline MipSelection select_mip_levels(double size2, std::size_t count) {
    constexpr double band = 1.0 / 3.0;
    if (!(size2 > 1.0)) { return {}; }
    const double level = 0.5 * coarse_log2(size2);
    const auto whole = static_cast<std::size_t>(level);
    if (whole + 1 >= count) { return {static_cast<std::uint16_t>(count - 1), 0}; }
    const double part = level - static_cast<double>(whole);
    const double share = std::clamp((part - 0.5) / band + 0.5, 0.0, 1.0);
    if (share >= 1.0) { return {static_cast<std::uint16_t>(whole + 1), 0}; }
    return {static_cast<std::uint16_t>(whole), static_cast<std::uint16_t>(share * 65535.0)};
}

/// Levels for pixels whose places move by such steps. Ground that is seen at a slant is longer in a pixel than wide:
/// the pixel takes the level of its width, at several places along its length. These are mixed anyway: then a single
/// level does.
inline MipSelection select_mip_levels(const TexelDerivatives& steps, std::size_t count) {
    constexpr double max_probes = 3.0;
    constexpr double longer = 1.5; ///< than wide, where two probes begin
    const auto& [across, down] = steps;
    const double across2 = across[0] * across[0] + across[1] * across[1];
    const double down2 = down[0] * down[0] + down[1] * down[1];
    const double length2 = std::max(across2, down2);
    const double area = std::abs(across[0] * down[1] - across[1] * down[0]);
    if (!(length2 > 1.0) || !(longer * area < length2)) { return select_mip_levels(length2, count); }
    double size = std::max(area / length2, 1.0 / max_probes); // of a probe, in lengths
    if (size * size * length2 < 1.0) {
        size = 1.0 / std::sqrt(length2); // no finer than the finest level
    }
    MipSelection selection = select_mip_levels(size * size * length2, count);
    selection.fine = static_cast<std::uint16_t>(selection.fine + (selection.coarse_share >> 15U));
    selection.coarse_share = 0;
    if (longer * size < 1.0 && std::size_t{selection.fine} + 1 < count) {
        selection.probes = size * (longer + 1.0) < 1.0 ? 3 : 2;
        const auto& longer_axis = across2 > down2 ? across : down;
        const double reach = 0.5 * (1.0 - size);
        selection.reach = {static_cast<float>(longer_axis[0] * reach), static_cast<float>(longer_axis[1] * reach)};
    }
    return selection;
}

} // namespace octant::visuals::raster
