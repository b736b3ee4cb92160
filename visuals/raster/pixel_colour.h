#pragma once

#include "visuals/raster/tile.h"

#include <array>
#include <cstdint>

namespace octant::visuals::raster {

/// Red, green and blue in 1/16 level, 0..4080.
using PixelColour = std::array<std::uint16_t, 3>;

/// The colour of a triangle of any fill at a pixel of the picture.
PixelColour colour_of(const TileTriangle& one, const TileJob& job, int column, int row);

/// The colour of a triangle of Fill::Lit at a pixel whose texel is so bright, 0..1.
PixelColour lit_colour_of(
    const TileTriangle& one, const TileJob& job, const glm::ivec2& at, const std::array<float, 3>& texel);

/// The colour of a triangle of the overlay at a pixel, alpha in the highest byte, red in the lowest.
std::uint32_t overlay_colour_of(const TileTriangle& one, int column, int row);

} // namespace octant::visuals::raster
