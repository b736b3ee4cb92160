#pragma once

#include "visuals/raster/projection.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::raster {

/// Mip levels of the ground's texture, and the number of samples along the longer axis of a pixel.
struct MipSelection {
    std::uint16_t fine = 0;
    std::uint16_t coarse_share = 0; ///< of the next level, 2^-16
    std::uint16_t probes = 1;       ///< at even distances along the pixel's longer way
    std::array<float, 2> reach{};   ///< from its middle to the last one, texels of the finest level
};

/// Derivatives of the texture coordinates to the next pixels, texels of the finest level.
struct TexelDerivatives {
    std::array<double, 2> across;
    std::array<double, 2> down;
};

/// Levels for pixels that are sqrt(`size2`) texels of the finest level wide, of a texture of `count` levels. Most
/// pixels take one level; two levels are mixed only in the middle third between them.
inline MipSelection select_mip_levels(double size2, std::size_t count) {
    // The logarithm to base 2, linear between whole numbers: wrong by less than 0.09.
    const auto coarse_log2 = [](double x) {
        const auto bits = std::bit_cast<std::uint64_t>(x);
        return static_cast<double>(static_cast<std::int64_t>(bits >> 20U)) * 0x1p-32 - 1023.0;
    };
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

/// Levels for pixels of a surface with these derivatives. The footprint of a pixel on slanted ground is longer than
/// wide: the pixel takes the level of the width at several places along the length. Their mean needs no second level.
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

/// Where an edge crosses the rows of pixels, from its top to its bottom whichever triangle it belongs to: two triangles
/// that share it compute the same crossings, bit for bit. Sums and products wrap; within the edge's own rows they are
/// right.
struct Edge {
    std::int64_t x = 0;     ///< at the middle of the row first_row_of(its top), 2^-32 pixel
    std::int64_t slope = 0; ///< x a row
};

/// The first row of pixels whose middle is not above a place, 1/256 pixel.
constexpr std::int32_t first_row_of(std::int32_t y) { return (y + 255) >> 8; }

/// Where an edge crosses the middle of a row, from a column on, 2^-32 pixel, as Edge::x. `top`: of the edge, 1/256
/// pixel. `first_px`: column and row of the picture.
inline std::uint64_t edge_x(const Edge& edge, std::int32_t top, const glm::ivec2& first_px) {
    // Less than the least distance of a crossing from a column's middle where it is not on it.
    constexpr std::uint64_t on_it = std::uint64_t{1} << 10;
    const auto rows = static_cast<std::uint64_t>(std::int64_t{first_px.y - first_row_of(top)});
    return static_cast<std::uint64_t>(edge.x) + static_cast<std::uint64_t>(edge.slope) * rows -
           (static_cast<std::uint64_t>(std::int64_t{first_px.x}) << 32) - on_it;
}

/// Red, green, blue and a fourth value over the picture: base + per_x * column + per_y * row at pixel middles,
/// wrapping. The fourth is alpha over the picture, on the ground the number of its covers.
struct ColourGradients {
    alignas(16) std::array<std::int32_t, 4> base{}; ///< 2^-16 level, from the level 128
    alignas(16) std::array<std::int32_t, 4> per_x{};
    alignas(16) std::array<std::int32_t, 4> per_y{};
    // 1/128 level, from the level 128 where it is none of a difference.
    std::array<std::int16_t, 4> per_column{}; ///< per_x
    std::array<std::int16_t, 4> min{};        ///< within the triangle
    std::array<std::int16_t, 4> max{};

    /// A value at a pixel of the picture, 2^-16 level from the level 128, wrapping.
    std::uint32_t wrapped(std::size_t i, const glm::ivec2& at) const {
        return static_cast<std::uint32_t>(base[i]) +
               static_cast<std::uint32_t>(per_x[i]) * static_cast<std::uint32_t>(at.x) +
               static_cast<std::uint32_t>(per_y[i]) * static_cast<std::uint32_t>(at.y);
    }

    /// The value in 1/128 level from the level 128, between `min` and `max`.
    std::int32_t level(std::size_t i, const glm::ivec2& at) const {
        const std::int32_t value = static_cast<std::int32_t>(wrapped(i, at) + 256U) >> 9;
        return std::clamp<std::int32_t>(value, min[i], max[i]);
    }
};

/// ColourGradients::level() in 1/16 level from 0.
constexpr std::uint16_t sixteenths_of(std::int32_t level) {
    return static_cast<std::uint16_t>((level + 128 * 128 + 4) >> 3);
}

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
    float min = 0.0F;
    float max = 0.0F;
};

/// How the colour of a triangle's pixels is found.
enum class Fill : std::uint8_t {
    Gouraud,     ///< three planes of colour
    Perspective, ///< as Gouraud, corrected for perspective
    Texture,     ///< planes of texture coordinates, light and haze: TexturePlanes
    TextureInPerspective,
    MeshEdges,  ///< colour, and lines along the edges
    Lit,        ///< by light and normal in each pixel
    Transparent ///< linear colours, blended by their alpha over farther surfaces
};

struct MeshTexture;

/// What a triangle of a mesh with a texture interpolates: over the picture 1 / w and all values over w are planes.
struct SurfacePlanes {
    enum class Value : std::uint8_t {
        InverseW,  ///< itself, 1/m
        U,         ///< place in the texture, shares of its width
        V,         ///< down, shares of its height
        HazeShare, ///< 0..1
        Red,       ///< of a white texel under the light, less what haze hides; levels, 255 = full, may be more
        Green,
        Blue
    };
    static constexpr std::size_t count = 8; ///< for registers; the last one is none

    // In the order of Value.
    alignas(32) std::array<float, count> base{}; ///< at the middle of first_px
    alignas(32) std::array<float, count> per_x{};
    alignas(32) std::array<float, count> per_y{};
    alignas(32) std::array<float, count> min{}; ///< of the values themselves at the corners
    alignas(32) std::array<float, count> max{};
    glm::ivec2 first_px{0};
    const MeshTexture* texture = nullptr;
    std::array<std::uint16_t, 3> haze{}; ///< red, green, blue, 1/128 level
};

/// What only some triangles need.
struct TriangleExtra {
    /// Pieces with DepthUse::OnGround are nearer by the slope of their depth over so many pixels.
    static constexpr double on_ground_offset_px = 1.0;

    AttributePlane depth;     ///< reversed: greater is nearer
    float depth_share = 1.0F; ///< times this: nearer or farther by a share of itself
    float opacity = 1.0F;     ///< as scene::PaintStep
    /// value / w of each value, then 1 / w.
    std::array<AttributePlane, 5> over_w{};
    std::array<ClipLine, scene::Clip::max_planes> cuts{};
    int cut_count = 0;
    std::array<AttributePlane, 3> from_edges{}; ///< over w; 1 at the corner opposite the edge
    std::array<const LitVertex*, 3> lit{};      ///< the corners, interpolated by from_edges, for Fill::Lit
    float mesh_level = 0.0F;                    ///< log2 of longest edge over sample spacing
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
    std::uint32_t extra = none;      ///< index into TriangleList::extras, or none
    std::uint32_t surface = none;    ///< index into TriangleList::surfaces, or none
    MipSelection texture;            ///< for Fill::Texture
    InverseDepthPlane inverse_depth; ///< of a triangle with detail texture
    std::uint16_t group = 0;         ///< depth group, from 1; 0: painted without depth
    scene::DepthUse depth = scene::DepthUse::None;
    Fill fill = Fill::Gouraud;
    bool middle_is_left = false;     ///< the middle corner lies left of the whole edge
    bool has_detail_texture = false; ///< land cover in the fourth colour value
    bool is_cloud = false;           ///< of those with Fill::Transparent
    bool is_sky = false;             ///< or land around the map
    bool is_under_side = false;      ///< of land or sky: its back is seen. The truth leaves it out
    std::uint32_t source = 0;        ///< where it comes from, as frame_draws.h numbers triangles; not of the overlay
};

/// Ground with detail texture at a pixel: one over its depth, 1/m, whose lowest bits are half the number of its covers.
/// Without them it is right to 2^-16 of itself: a tenth of a pixel's width.
struct PackedGround {
    static constexpr std::uint32_t cover_bits = 0x7f;
    static constexpr int cover_shift = 17; ///< from 2^-16 level
    /// The sample of a pixel whose ground is recorded, one of those next to its middle. If any farther sample counted,
    /// one that falls to the other side of a ridge's edge would change the pattern of all pixels around.
    static constexpr std::uint32_t sample = 1U << 7;

    /// The land cover at a pixel: the gradients' fourth value, in 2^-16 level from 0.
    static std::uint32_t first_cover(const ColourGradients& gradients, const glm::ivec2& at) {
        return gradients.wrapped(3, at) + (128U << 16U);
    }

    /// The lowest or highest level of a gradient in the same unit.
    static constexpr std::int32_t limit(std::int16_t level) { return (std::int32_t{level} + 128 * 128) * 512; }
};

/// A PackedGround of a triangle with detail texture at a pixel of the picture.
inline std::uint32_t ground_at(const Triangle& triangle, int column, int row) {
    const InverseDepthPlane& plane = triangle.inverse_depth;
    const float in_row = plane.first + plane.per_y * static_cast<float>(row - triangle.first_row);
    const float value = in_row + static_cast<float>(column - triangle.left) * plane.per_x;
    const float near = std::min(std::max(value, plane.min), plane.max);
    const ColourGradients& gradients = triangle.gradients;
    const std::int32_t cover =
        std::clamp(static_cast<std::int32_t>(PackedGround::first_cover(gradients, {column, row})),
            PackedGround::limit(gradients.min[3]), PackedGround::limit(gradients.max[3]));
    return (std::bit_cast<std::uint32_t>(near) & ~PackedGround::cover_bits) |
           (static_cast<std::uint32_t>(cover) >> PackedGround::cover_shift);
}

} // namespace octant::visuals::raster
