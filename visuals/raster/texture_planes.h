#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"
#include "visuals/scene/picture.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace octant::visuals::raster {

/// The planes over the picture by which textured triangles are painted: ColourGradients whose first two values are
/// texture coordinates in texels of the fine mip level, and whose last two are light and haze, as shares of
/// whole_share.
struct TexturePlanes {
    /// A little less than 256, whose double would need more than sixteen bits.
    static constexpr float whole_share = 255.98F;

    ColourGradients gradients;
    MipSelection mip_selection;
    bool is_accurate = false; ///< wrong by at most 1/16 texel, and light and haze by at most 1/512
};

/// Units of 2^-16 texel of a level in a texel of the finest level.
inline double texel_scale(std::size_t level) { return 65536.0 / static_cast<double>(std::uint64_t{1} << level); }

/// Planes that are exact in the middle of some pixels of the picture, whose perspective `extra` holds.
TexturePlanes fit_texture_planes(const TriangleExtra& extra, const scene::PixelRect& pixels, std::size_t level_count);

/// A textured triangle whose planes hold for all of it, because perspective bends them by at most 1/32 texel, and light
/// and haze by at most 1/512.
struct AffineTexturedTriangle {
    std::array<ScreenVertex, 3> vertices; ///< with values as in TexturePlanes
    MipSelection mip_selection;
};

/// Texture coordinates are moved so that they are as much too far at one corner or edge as too near at another. Nothing
/// where perspective bends them too much. `vertices` are placed, with coordinates in texels of the finest of
/// `level_count` levels.
std::optional<AffineTexturedTriangle> fit_affine_texture(
    const std::array<const ScreenVertex*, 3>& vertices, std::size_t level_count);

} // namespace octant::visuals::raster
