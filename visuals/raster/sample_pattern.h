#pragma once

#include <array>
#include <cstdint>

namespace octant::visuals::raster {

/// Where the samples of a pixel lie. A pixel always has sixteen lanes; with fewer samples several lanes share a place,
/// so that all counts of samples take the same way and weigh alike.
struct SamplePattern {
    static constexpr int lanes = 16;
    /// Sample pixels lie `1 / unit` apart in both directions; places are odd multiples or zero, from the pixel's
    /// middle.
    static constexpr int unit = 32;
    std::array<std::int32_t, lanes> x{}; ///< right, 1/32 pixel
    std::array<std::int32_t, lanes> y{}; ///< down, 1/32 pixel, ascending
    std::int32_t reach = 0;              ///< greatest of all |x| and |y|
};

/// For 1, 4 or 16 samples a pixel. One lies in the middle. Four lie as OpenGL's drivers put them. Sixteen are rooks:
/// one in each of sixteen rows and sixteen columns, spread so that edges and thin lines of all directions are met by
/// about as many as their area.
SamplePattern sample_pattern(int samples);

} // namespace octant::visuals::raster
