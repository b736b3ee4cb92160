// Places in a texture as planes over the picture, where perspective bends them by next to nothing. Included once for
// each instruction set.
#if defined(OCTANT_RASTER_AFFINE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_AFFINE_INL
#undef OCTANT_RASTER_AFFINE_INL
#else
#define OCTANT_RASTER_AFFINE_INL
#endif

#include "visuals/raster/strip_gradient-inl.h"
#include "visuals/raster/texel_fetch-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// A textured triangle's values in a part of a tile, as planes that are right in the part's middle. A value there is v0
/// + (s dx + t dy) / (1 + e), where e is how much 1 / w differs from the middle's, as a share of it: without e it is
/// wrong by no more than |s dx + t dy| |e| / (1 - |e|).
class AffineSpan {
public:
    static constexpr double max_texels_wrong = 1.0 / 16.0; ///< of the level that is looked at
    static constexpr double max_share_wrong = 1.0 / 512.0; ///< of light and haze

    HWY_INLINE AffineSpan(
        const TexturePlanes& planes, const LitGroundTexture& image, const glm::ivec2& tile_px, const TileBox& part)
        : first_px_(tile_px + glm::ivec2(part.left, part.first_row)) {
        const glm::dvec2 half_px(0.5 * (part.right - part.left), 0.5 * (part.last_row - part.first_row));
        const TexturePoint middle = planes.at(first_px_.x + half_px.x, first_px_.y + half_px.y);
        const auto slope = [&](const Four& per_px, double over_w) HWY_ATTR {
            return stored(four([&](std::size_t i) HWY_ATTR {
                const auto turned = hn::Mul(middle.value[i], real(over_w));
                return hn::Mul(hn::Sub(per_px[i], turned), real(middle.w));
            }));
        };
        const Values value = stored(middle.value);
        const Values per_x = slope(planes.per_x, planes.over_w.per_x);
        const Values per_y = slope(planes.per_y, planes.over_w.per_y);
        chosen = select_mip_levels(TexelDerivatives{{per_x[0], per_x[1]}, {per_y[0], per_y[1]}}, image.levels().size());
        // Pixels that begin beyond the part keep numbers in their range.
        const glm::dvec2 reach_px = half_px + 1.0;
        const double bent =
            (std::abs(planes.over_w.per_x) * reach_px.x + std::abs(planes.over_w.per_y) * reach_px.y) * middle.w;
        is_accurate = bent < 0.5;
        const double texel = 65536.0 / texel_scale(chosen.fine);
        Values first;
        for (std::size_t i = 0; i < value.size(); ++i) {
            const double reach = std::abs(per_x[i]) * reach_px.x + std::abs(per_y[i]) * reach_px.y;
            const double limit = i < 2 ? max_texels_wrong * texel : max_share_wrong;
            const double range = i < 2 ? max_texels * texel : max_share;
            is_accurate = is_accurate && reach * bent <= limit * (1.0 - bent) && std::abs(value[i]) + reach < range;
            first[i] = value[i] - per_x[i] * half_px.x - per_y[i] * half_px.y;
        }
        if (is_accurate) { set_planes(first, per_x, per_y); }
    }

    /// Of the chosen level or the next coarser one, from a pixel of the picture on.
    HWY_INLINE TexelSpan line(std::size_t coarser, const glm::ivec2& at) const {
        const glm::ivec2 off = at - first_px_;
        const auto& [x, y] = places_[coarser];
        return {{x.at(off), y.at(off)}, {x.per_x, y.per_x}};
    }

    /// Light left or haze, 2^-16, of a block from a pixel of the picture on.
    HWY_INLINE void share(std::size_t which, const glm::ivec2& at, std::array<std::uint16_t, block_px>& to) const {
        using Signed = hn::RebindToSigned<Pixels>;
        constexpr int coarser = 12; ///< from share_unit to 2^-14
        const Plane& plane = shares_[which];
        const auto first = hn::Set(Signed(), static_cast<std::int16_t>(plane.at(at - first_px_) >> coarser));
        const auto per_px = hn::Set(Signed(), static_cast<std::int16_t>(plane.per_x >> coarser));
        for (std::size_t i = 0; i < block_px; i += hn::Lanes(Pixels())) {
            const auto steps = lane_indices_from(Signed(), i);
            const auto value = hn::Add(first, hn::Mul(steps, per_px));
            const auto within = hn::Min(hn::Max(value, hn::Zero(Signed())), hn::Set(Signed(), 16383));
            hn::StoreU(hn::ShiftLeft<2>(hn::BitCast(Pixels(), within)), Pixels(), &to[i]);
        }
    }

    bool is_accurate; ///< as said above; if not, nothing else is to be used
    MipSelection chosen;

private:
    using Values = std::array<double, 4>;
    static constexpr double share_unit = 0x1p26;
    static constexpr double max_texels = 16384.0; ///< what 32 bits hold, 2^-16, and half of it
    static constexpr double max_share = 1.9;      ///< what 16 bits hold, 2^-14

    /// Whole numbers that wrap.
    struct Plane {
        std::int32_t base;
        std::int32_t per_x;
        std::int32_t per_y;

        Plane() = default;

        HWY_INLINE Plane(double at_first, double step_x, double step_y)
            : base(static_cast<std::int32_t>(at_first)), per_x(static_cast<std::int32_t>(step_x)),
              per_y(static_cast<std::int32_t>(step_y)) {}

        HWY_INLINE std::int32_t at(const glm::ivec2& off) const {
            return static_cast<std::int32_t>(static_cast<std::uint32_t>(base) +
                                             static_cast<std::uint32_t>(per_x) * static_cast<std::uint32_t>(off.x) +
                                             static_cast<std::uint32_t>(per_y) * static_cast<std::uint32_t>(off.y));
        }
    };

    static HWY_INLINE Values stored(const Four& values) {
        alignas(32) Values result;
        for (std::size_t i = 0; i < four_parts; ++i) {
            hn::Store(values[i], Reals(), &result[i * hn::MaxLanes(Reals())]);
        }
        return result;
    }

    HWY_INLINE void set_planes(const Values& first, const Values& per_x, const Values& per_y) {
        for (std::size_t k = 0; k < 2; ++k) {
            const double scale = texel_scale(chosen.fine + k);
            for (std::size_t i = 0; i < 2; ++i) {
                places_[k][i] = Plane((first[i] + 0.5) * scale - 32768.0, per_x[i] * scale, per_y[i] * scale);
            }
            const std::size_t i = 2 + k;
            shares_[k] = Plane(first[i] * share_unit, per_x[i] * share_unit, per_y[i] * share_unit);
        }
    }

    glm::ivec2 first_px_;
    std::array<std::array<Plane, 2>, 2> places_; ///< of the chosen level and the next coarser one
    std::array<Plane, 2> shares_;                ///< light left and haze, share_unit
};

/// A textured triangle's planes in its part of a tile: for all of it where they are near enough, else for a few rows at
/// a time.
class AffineRows {
public:
    HWY_INLINE AffineRows(
        const TexturePlanes& planes, const LitGroundTexture& image, const glm::ivec2& tile_px, const TileBox& box)
        : planes_(planes), image_(image), tile_px_(tile_px), box_(box), current_box_(box),
          texture_(planes, image, tile_px, box) {
        if (!texture_.is_accurate) {
            current_box_.last_row = current_box_.first_row - 1; // none
        }
    }

    /// Of a row of the tile, which lies in the triangle's part.
    HWY_INLINE const AffineSpan& of(int row) {
        if (row < current_box_.first_row || row > current_box_.last_row) {
            constexpr int few = 4;
            current_box_.first_row = row;
            current_box_.last_row = std::min(row + few - 1, box_.last_row);
            texture_ = AffineSpan(planes_, image_, tile_px_, current_box_);
        }
        return texture_;
    }

private:
    const TexturePlanes& planes_;
    const LitGroundTexture& image_;
    glm::ivec2 tile_px_;
    TileBox box_;
    TileBox current_box_;
    AffineSpan texture_;
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
