#pragma once

#include "visuals/raster/mip_selection.h"
#include "visuals/raster/screen_vertex.h"
#include "visuals/scene/paint_step.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace octant::visuals::raster {

/// Where an edge crosses the rows of pixels, from its top to its bottom whichever triangle it belongs to: two triangles
/// that share it compute the same crossings, bit for bit. Sums and products wrap; within the edge's own rows they are
/// right.
struct Edge {
    std::int64_t x = 0;     ///< at the middle of the row first_row_of(its top), 2^-32 pixel
    std::int64_t slope = 0; ///< x a row
};

/// The first row of pixels whose middle is not above a place, 1/256 pixel.
constexpr std::int32_t first_row_of(std::int32_t y) { return (y + 255) >> 8; }

/// Red, green, blue and a fourth value over the picture: base + per_x * column + per_y * row at pixel middles,
/// wrapping. The fourth is alpha over the picture, on the ground the number of its covers.
struct ColourGradients {
    alignas(16) std::array<std::int32_t, 4> base{}; ///< 2^-16 level, from the level 128
    alignas(16) std::array<std::int32_t, 4> per_x{};
    alignas(16) std::array<std::int32_t, 4> per_y{};
    // 1/128 level, from the level 128 where it is none of a difference.
    std::array<std::int16_t, 4> per_column{}; ///< per_x
    std::array<std::int16_t, 4> least{};      ///< within the triangle
    std::array<std::int16_t, 4> most{};
};

/// A value over the picture: base + per_x * column + per_y * row, at pixel middles.
struct AttributePlane {
    double base = 0.0;
    double per_x = 0.0;
    double per_y = 0.0;

    double at(double column, double row) const { return base + per_x * column + per_y * row; }
};

/// What is drawn where a * column + b * row + c >= 0.
struct ClipLine {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
};

/// One over the depth along the line of sight within a triangle, 1/m: at pixel middles from its column `left` and row
/// `first_row` on, and no less and no more than at its corners.
struct InverseDepthPlane {
    float first = 0.0F;
    float per_x = 0.0F;
    float per_y = 0.0F;
    float least = 0.0F;
    float most = 0.0F;
};

/// How the colour of a triangle's pixels is found.
enum class Fill : std::uint8_t {
    Gouraud,     ///< three planes of levels
    Perspective, ///< as Levels, corrected for perspective
    Texture,     ///< places in the texture, light and haze as planes: AffineTexturedTriangle
    TextureInPerspective,
    Mesh,       ///< levels, and lines along the edges
    Lit,        ///< by light and normal in each pixel
    Transparent ///< levels, blended by their alpha over what lies farther
};

/// What only some triangles need.
struct TriangleExtra {
    AttributePlane depth;     ///< reversed: greater is nearer
    float depth_share = 1.0F; ///< times this: nearer or farther by a share of itself
    float opacity = 1.0F;     ///< as scene::PaintStep
    /// value / w of each value, then 1 / w.
    std::array<AttributePlane, 5> over_w{};
    std::array<ClipLine, scene::Clip::max_planes> cuts{};
    int cut_count = 0;
    std::array<AttributePlane, 3> from_edges{}; ///< over w; 1 at the corner opposite the edge
    std::array<const LitVertex*, 3> lit{};      ///< of from_edges, for Fill::Lit
    float mesh_level = 0.0F;                    ///< how many times the longest edge is twice the sample spacing
};

/// A triangle on the picture.
struct Triangle {
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    Edge whole;           ///< from the top to the bottom corner
    Edge upper;           ///< from the top to the middle corner
    Edge lower;           ///< from the middle to the bottom corner
    std::int32_t top = 0; ///< 1/256 pixel
    std::int32_t middle = 0;
    std::int32_t bottom = 0;
    std::int32_t left = 0; ///< columns that may be covered: left to right
    std::int32_t right = 0;
    std::int32_t first_row = 0; ///< rows that may be covered: first_row to last_row
    std::int32_t last_row = 0;
    ColourGradients gradients;
    std::uint32_t extra = none;      ///< index into the chunk's extras
    MipSelection texture;            ///< for Fill::Texture
    InverseDepthPlane inverse_depth; ///< of one with grain
    std::uint16_t group = 0;         ///< depth group, from 1; 0: painted without depth
    scene::DepthUse depth = scene::DepthUse::None;
    Fill fill = Fill::Gouraud;
    bool middle_is_left = false;     ///< the middle corner lies left of the whole edge
    bool has_detail_texture = false; ///< the fine pattern, by the levels' fourth value
};

/// Ground with the fine pattern at a pixel: one over its depth, 1/m, whose lowest bits are half the number of its
/// covers. Without them it is right to 2^-16 of itself: a tenth of a pixel's width.
struct PackedGround {
    static constexpr std::uint32_t cover_bits = 0x7f;
    static constexpr int cover_shift = 17; ///< from 2^-16 level

    /// Levels' fourth value at a place, 2^-16 level from 0.
    static std::uint32_t first_cover(const ColourGradients& gradients, const glm::ivec2& at) {
        return static_cast<std::uint32_t>(gradients.base[3]) + (128U << 16U) +
               static_cast<std::uint32_t>(gradients.per_x[3]) * static_cast<std::uint32_t>(at.x) +
               static_cast<std::uint32_t>(gradients.per_y[3]) * static_cast<std::uint32_t>(at.y);
    }

    /// Levels' least or most in the same unit.
    static constexpr std::int32_t limit(std::int16_t level) { return (std::int32_t{level} + 128 * 128) * 512; }
};

/// A PackedGround of a triangle with grain at a pixel of the picture.
inline std::uint32_t ground_at(const Triangle& triangle, int column, int row) {
    const InverseDepthPlane& plane = triangle.inverse_depth;
    const float in_row = plane.first + plane.per_y * static_cast<float>(row - triangle.first_row);
    const float value = in_row + static_cast<float>(column - triangle.left) * plane.per_x;
    const float near = std::min(std::max(value, plane.least), plane.most);
    const ColourGradients& gradients = triangle.gradients;
    const std::int32_t cover =
        std::clamp(static_cast<std::int32_t>(PackedGround::first_cover(gradients, {column, row})),
            PackedGround::limit(gradients.least[3]), PackedGround::limit(gradients.most[3]));
    return (std::bit_cast<std::uint32_t>(near) & ~PackedGround::cover_bits) |
           (static_cast<std::uint32_t>(cover) >> PackedGround::cover_shift);
}

} // namespace octant::visuals::raster
