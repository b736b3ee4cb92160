#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"

#include <array>
#include <cstddef>
#include <optional>

namespace octant::visuals::raster {

/// A textured triangle whose places, light and haze may lie even between its corners, because perspective bends them by
/// next to nothing.
struct AffineTexturedTriangle {
    static constexpr float max_texels_wrong = 1.0F / 32.0F; ///< of the level that is looked at
    static constexpr float max_share_wrong = 1.0F / 512.0F; ///< of light and haze
    /// Of light and haze in ScreenVertex::value: a little less than 256, whose double would need more than sixteen
    /// bits.
    static constexpr float whole_share = 255.98F;

    /// Their values are as those of levels: places in texels of the fine level, shares of whole_share.
    std::array<ScreenVertex, 3> vertices;
    MipSelection mip_selection;
};

/// Places are moved so that they are as much too far at one corner or edge as too near at another. Nothing where
/// perspective bends too much. `vertices` are placed, with places in texels of the finest of `level_count` levels.
std::optional<AffineTexturedTriangle> fit_affine_texture(
    const std::array<const ScreenVertex*, 3>& vertices, std::size_t level_count);

} // namespace octant::visuals::raster
