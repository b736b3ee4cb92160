// Triangles of meshes with textures, sampled at each pixel that has fresh samples: fragments. Eight are shaded at once,
// each by itself, so that its colour does not depend on the others. In this order: the filter of one level; the
// footprint of a fragment and the levels and places that it takes; the colour under light and behind haze; fragments of
// a triangle; holes. Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURED_MESH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURED_MESH_INL
#undef OCTANT_RASTER_TEXTURED_MESH_INL
#else
#define OCTANT_RASTER_TEXTURED_MESH_INL
#endif

#include "visuals/raster/gouraud_triangle-inl.h"
#include "visuals/raster/mesh_texture.h"
#include "visuals/raster/strip_coverage-inl.h"
#include "visuals/raster/textured_triangle-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t fragments_at_once = PlacedFragments::at_once;
using Fragment = hn::CappedTag<float, fragments_at_once>;
using FragmentWhole = hn::RebindToSigned<Fragment>;
using FragmentBits = hn::RebindToUnsigned<Fragment>;
using FragmentHalves = hn::Repartition<std::uint16_t, FragmentBits>;
using FragmentReal = hn::Vec<Fragment>;
using FragmentWholes = hn::Vec<FragmentWhole>;

HWY_INLINE FragmentReal each(float value) { return hn::Set(Fragment(), value); }

/// The same number of sixteen bits in both halves of a lane.
HWY_INLINE hn::Vec<FragmentHalves> in_both_halves(FragmentWholes value) {
    return hn::BitCast(FragmentHalves(), hn::Or(value, hn::ShiftLeft<16>(value)));
}

// -- The bilinear filter of one level. Two colours of a texel are mixed at once, sixteen bits each.

/// Colours of texels in 1/128 level, 32,640 at most.
struct MeshTexels {
    hn::Vec<FragmentHalves> red_and_blue; ///< red in the lower halves
    hn::Vec<FragmentHalves> green_and_alpha;

    template <class Function>
    HWY_INLINE MeshTexels changed(const Function& function) const {
        return {function(red_and_blue), function(green_and_alpha)};
    }

    template <class Function>
    static HWY_INLINE MeshTexels mixed(const MeshTexels& a, const MeshTexels& b, const Function& function) {
        return {function(a.red_and_blue, b.red_and_blue), function(a.green_and_alpha, b.green_and_alpha)};
    }
};

/// The two texels next to places along an axis of a level.
struct TexelPair {
    FragmentWholes low;
    FragmentWholes high;
    FragmentReal high_share; ///< 0..1

    /// `place`: in shares of the picture.
    HWY_INLINE TexelPair(FragmentReal place, std::int32_t size, models::TextureWrap wrap) {
        using Wrap = models::TextureWrap;
        const auto one = each(1.0F);
        auto within = hn::Sub(place, hn::Floor(place));
        if (wrap == Wrap::Clamp) {
            within = hn::Min(hn::Max(place, hn::Zero(Fragment())), one);
        } else if (wrap == Wrap::Mirror) {
            const auto two = each(2.0F);
            const auto pairs = hn::Floor(hn::Mul(place, each(0.5F)));
            const auto in_pair = hn::Sub(place, hn::Mul(two, pairs));
            within = hn::Min(in_pair, hn::Sub(two, in_pair));
        }
        const auto texel = hn::Sub(hn::Mul(within, each(static_cast<float>(size))), each(0.5F));
        const auto below = hn::Floor(texel);
        high_share = hn::Sub(texel, below);
        low = hn::ConvertTo(FragmentWhole(), below);
        high = hn::Add(low, hn::Set(FragmentWhole(), 1));
        const auto none = hn::Zero(FragmentWhole());
        const auto last = hn::Set(FragmentWhole(), size - 1);
        const bool repeats = wrap == Wrap::Repeat;
        low = hn::IfThenElse(hn::Lt(low, none), repeats ? last : none, low);
        high = hn::IfThenElse(hn::Gt(high, last), repeats ? none : last, high);
    }
};

/// The texels of a row at the left and at the right ones of pairs.
using TexelsOfRow = std::array<hn::Vec<FragmentBits>, 2>;

HWY_INLINE TexelsOfRow load_row(const std::uint32_t* texels, FragmentWholes row, const TexelPair& pair) {
    return {hn::GatherIndex(FragmentBits(), texels, hn::Add(row, pair.low)),
        hn::GatherIndex(FragmentBits(), texels, hn::Add(row, pair.high))};
}

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2

/// The same where all pairs are adjacent.
HWY_INLINE TexelsOfRow load_adjacent(const std::uint32_t* texels, FragmentWholes row, const TexelPair& pair) {
    const TexelPairs pairs(texels, hn::Add(row, pair.low).raw);
    TexelsOfRow made;
    made[0].raw = pairs.left;
    made[1].raw = pairs.right;
    return made;
}

#else

HWY_INLINE TexelsOfRow load_adjacent(const std::uint32_t* texels, FragmentWholes row, const TexelPair& pair) {
    return load_row(texels, row, pair);
}

#endif

HWY_INLINE MeshTexels filter_level(const MeshTexture& from, std::size_t number, FragmentReal u, FragmentReal v) {
    const MeshTexture::Level& level = from.levels[number];
    const TexelPair x(u, level.width, from.texture.wrap_u);
    const TexelPair y(v, level.height, from.texture.wrap_v);
    const auto stride = hn::Set(FragmentWhole(), level.width);
    const auto upper_row = hn::Mul(y.low, stride);
    const auto lower_row = hn::Mul(y.high, stride);
    const bool is_adjacent = hn::AllTrue(FragmentWhole(), hn::Gt(x.high, x.low)); // else some lie at the rim
    const TexelsOfRow upper =
        is_adjacent ? load_adjacent(level.texels, upper_row, x) : load_row(level.texels, upper_row, x);
    const TexelsOfRow lower =
        is_adjacent ? load_adjacent(level.texels, lower_row, x) : load_row(level.texels, lower_row, x);
    const std::array texels{upper[0], upper[1], lower[0], lower[1]};
    const auto right = in_both_halves(hn::ConvertTo(FragmentWhole(), hn::Mul(x.high_share, each(65536.0F)))); // 2^-16
    const auto down = in_both_halves(hn::ConvertTo(FragmentWhole(), hn::Mul(y.high_share, each(128.0F))));
    const auto up = hn::Sub(hn::Set(FragmentHalves(), 128), down);
    const auto mixed = [&](const auto& two_colours) HWY_ATTR {
        const auto column = [&](std::size_t side) HWY_ATTR {
            return hn::Add(hn::Mul(two_colours(texels[side]), up), hn::Mul(two_colours(texels[side + 2]), down));
        };
        // The left texel has what the right one leaves of 65,535.
        return hn::Add(hn::MulHigh(column(0), hn::Not(right)), hn::MulHigh(column(1), right));
    };
    const auto bytes = hn::Set(FragmentBits(), 0x00ff00ffU);
    return {mixed([&](hn::Vec<FragmentBits> texel)
                      HWY_ATTR { return hn::BitCast(FragmentHalves(), hn::And(texel, bytes)); }),
        mixed([&](hn::Vec<FragmentBits> texel)
                  HWY_ATTR { return hn::BitCast(FragmentHalves(), hn::And(hn::ShiftRight<8>(texel), bytes)); })};
}

/// The same where each fragment has a level of its own.
HWY_INLINE MeshTexels filter_levels(const MeshTexture& from, FragmentWholes levels, FragmentReal u, FragmentReal v) {
    const std::int32_t first = hn::GetLane(levels);
    if (hn::AllTrue(FragmentWhole(), hn::Eq(levels, hn::Set(FragmentWhole(), first)))) {
        return filter_level(from, static_cast<std::size_t>(first), u, v);
    }
    MeshTexels all{hn::Zero(FragmentHalves()), hn::Zero(FragmentHalves())};
    for (std::size_t level = 0; level < from.levels.size(); ++level) {
        const auto is_own = hn::Eq(levels, hn::Set(FragmentWhole(), static_cast<std::int32_t>(level)));
        if (hn::AllFalse(FragmentWhole(), is_own)) { continue; }
        const auto own = hn::BitCast(FragmentHalves(), hn::VecFromMask(FragmentWhole(), is_own));
        all = MeshTexels::mixed(filter_level(from, level, u, v), all,
            [&](auto one, auto before) HWY_ATTR { return hn::IfVecThenElse(own, one, before); });
    }
    return all;
}

// -- What a fragment takes of the texture: of a footprint that is longer than wide, a few places along its length at
// the level of its width; else one place, in the middle third between two levels the mixture of both. As
// select_mip_levels() for the ground's texture.

/// A step from a pixel to the next one, in shares of the picture.
struct TextureStep {
    FragmentReal u;
    FragmentReal v;
};

struct MeshFootprint {
    FragmentWholes level;
    FragmentReal coarse_share; ///< of the next level
    FragmentReal places;       ///< 1, 2 or 3
    TextureStep reach;         ///< to the outermost place

    /// Of placed fragments, from number `i` on.
    HWY_INLINE MeshFootprint(const PlacedFragments& placed, std::size_t i)
        : level(hn::Load(FragmentWhole(), placed.level.data() + i)),
          coarse_share(hn::Load(Fragment(), placed.coarse_share.data() + i)),
          places(hn::Load(Fragment(), placed.places.data() + i)), reach{hn::Load(Fragment(), placed.reach_u.data() + i),
                                                                      hn::Load(Fragment(), placed.reach_v.data() + i)} {
    }

    HWY_INLINE void store(PlacedFragments& placed, std::size_t i) const {
        hn::Store(level, FragmentWhole(), placed.level.data() + i);
        hn::Store(coarse_share, Fragment(), placed.coarse_share.data() + i);
        hn::Store(places, Fragment(), placed.places.data() + i);
        hn::Store(reach.u, Fragment(), placed.reach_u.data() + i);
        hn::Store(reach.v, Fragment(), placed.reach_v.data() + i);
    }

    HWY_INLINE MeshFootprint(const MeshTexture& from, const TextureStep& across, const TextureStep& down) {
        const auto one = each(1.0F);
        const auto none = hn::Zero(Fragment());
        const auto width = each(static_cast<float>(from.levels[0].width));
        const auto height = each(static_cast<float>(from.levels[0].height));
        const TextureStep right{hn::Mul(across.u, width), hn::Mul(across.v, height)};
        const TextureStep below{hn::Mul(down.u, width), hn::Mul(down.v, height)};
        const auto squared = [](const TextureStep& step)
                                 HWY_ATTR { return hn::Add(hn::Mul(step.u, step.u), hn::Mul(step.v, step.v)); };
        const auto right2 = squared(right);
        const auto below2 = squared(below);
        const auto length2 = hn::Max(right2, below2);
        const auto area = hn::Abs(hn::Sub(hn::Mul(right.u, below.v), hn::Mul(right.v, below.u)));
        const auto is_long = hn::And(hn::Gt(length2, one), hn::Lt(hn::Mul(each(longer), area), length2));
        auto size = hn::Max(hn::Div(area, hn::Max(length2, one)), each(1.0F / max_places)); // of a place, in lengths
        // No finer than the finest level.
        const auto is_fine = hn::Lt(hn::Mul(hn::Mul(size, size), length2), one);
        size = hn::IfThenElse(is_fine, hn::Div(one, hn::Sqrt(hn::Max(length2, one))), size);
        size = hn::IfThenElse(is_long, size, one);
        const auto last = each(static_cast<float>(from.levels.size() - 1));
        const auto exact = hn::Min(half_log2(hn::Max(hn::Mul(hn::Mul(size, size), length2), one)), last);
        const auto whole = hn::Floor(exact);
        const auto beyond = hn::Sub(hn::Sub(exact, whole), each(0.5F));
        const auto share = hn::Min(hn::Max(hn::Add(hn::Mul(beyond, each(3.0F)), each(0.5F)), none), one);
        const auto is_next = hn::Ge(share, hn::IfThenElse(is_long, each(0.5F), one));
        const auto taken = hn::Min(hn::Add(whole, hn::IfThenElseZero(is_next, one)), last);
        level = hn::ConvertTo(FragmentWhole(), taken);
        const auto has_next = hn::Lt(taken, last);
        const auto is_between = hn::AndNot(hn::Or(is_long, is_next), has_next);
        coarse_share = hn::IfThenElseZero(is_between, share);
        const auto has_several = hn::And(hn::And(is_long, has_next), hn::Lt(hn::Mul(each(longer), size), one));
        const auto two_or_three =
            hn::IfThenElse(hn::Lt(hn::Mul(each(longer + 1.0F), size), one), each(3.0F), each(2.0F));
        places = hn::IfThenElse(has_several, two_or_three, one);
        const auto to_last = hn::IfThenElseZero(has_several, hn::Mul(each(0.5F), hn::Sub(one, size)));
        const auto is_across = hn::Gt(right2, below2);
        reach = {hn::Mul(to_last, hn::IfThenElse(is_across, across.u, down.u)),
            hn::Mul(to_last, hn::IfThenElse(is_across, across.v, down.v))};
    }

private:
    static constexpr float max_places = 3.0F;
    static constexpr float longer = 1.5F; ///< than wide, where two places begin

    /// Half the logarithm to base 2, linear between powers of two.
    static HWY_INLINE FragmentReal half_log2(FragmentReal x) {
        const auto exponent = hn::Sub(hn::BitCast(FragmentWhole(), x), hn::Set(FragmentWhole(), 127 << 23));
        return hn::Mul(hn::ConvertTo(Fragment(), exponent), each(0x1p-24F));
    }
};

/// The mixture with the next level where a fragment has a share of it.
HWY_INLINE MeshTexels with_coarse(
    const MeshTexels& fine, const MeshTexture& from, const MeshFootprint& footprint, FragmentReal u, FragmentReal v) {
    if (hn::AllFalse(Fragment(), hn::Gt(footprint.coarse_share, hn::Zero(Fragment())))) { return fine; }
    const auto last = hn::Set(FragmentWhole(), static_cast<std::int32_t>(from.levels.size() - 1));
    const auto next = hn::Min(hn::Add(footprint.level, hn::Set(FragmentWhole(), 1)), last);
    const auto share = in_both_halves(hn::ConvertTo(FragmentWhole(), hn::Mul(footprint.coarse_share, each(65535.0F))));
    return MeshTexels::mixed(fine, filter_levels(from, next, u, v), [&](auto own, auto other) HWY_ATTR {
        return hn::Add(hn::Sub(own, hn::MulHigh(own, share)), hn::MulHigh(other, share));
    });
}

HWY_INLINE MeshTexels sampled(const MeshTexture& from, const MeshFootprint& footprint, FragmentReal u, FragmentReal v) {
    const auto at = [&](FragmentReal far) HWY_ATTR {
        return filter_levels(from, footprint.level, hn::Add(u, hn::Mul(far, footprint.reach.u)),
            hn::Add(v, hn::Mul(far, footprint.reach.v)));
    };
    const auto is_several = hn::Gt(footprint.places, each(1.5F));
    // Fragments of several places have one level, those of two levels one place, which their reach of 0 leaves.
    const MeshTexels first = with_coarse(at(each(-1.0F)), from, footprint, u, v);
    if (hn::AllFalse(Fragment(), is_several)) { return first; }
    const auto is_three = hn::Gt(footprint.places, each(2.5F));
    const auto share_of_two = hn::Set(FragmentWhole(), 65535 / 2);
    const auto share_of_three = hn::Set(FragmentWhole(), 65535 / 3);
    const auto three = hn::RebindMask(FragmentWhole(), is_three);
    const auto share = in_both_halves(hn::IfThenElse(three, share_of_three, share_of_two));
    const auto add = [&](auto sum, auto one) HWY_ATTR { return hn::Add(sum, hn::MulHigh(one, share)); };
    const auto of_first = [&](auto one) HWY_ATTR { return hn::MulHigh(one, share); };
    MeshTexels sum = MeshTexels::mixed(first.changed(of_first), at(each(1.0F)), add);
    if (!hn::AllFalse(Fragment(), is_three)) {
        const auto middle = hn::BitCast(FragmentHalves(), hn::VecFromMask(FragmentWhole(), three));
        sum = MeshTexels::mixed(sum, at(hn::Zero(Fragment())),
            [&](auto before, auto one) HWY_ATTR { return hn::Add(before, hn::And(middle, hn::MulHigh(one, share))); });
    }
    const auto several =
        hn::BitCast(FragmentHalves(), hn::VecFromMask(FragmentWhole(), hn::RebindMask(FragmentWhole(), is_several)));
    return MeshTexels::mixed(
        sum, first, [&](auto mean, auto single) HWY_ATTR { return hn::IfVecThenElse(several, mean, single); });
}

// -- The colour of fragments.

/// Eight fragments of a triangle.
struct ShadedFragments {
    /// As PixelColour, two of sixteen bits: red and blue, blue in the upper half; green.
    alignas(32) std::array<std::uint32_t, fragments_at_once> red_and_blue;
    alignas(32) std::array<std::uint32_t, fragments_at_once> green;
    alignas(32) std::array<std::uint32_t, fragments_at_once> alpha; ///< 65,535 = full
    // The texture's own colours, 65,535 = full.
    alignas(32) std::array<std::uint32_t, fragments_at_once> texel_red_and_blue;
    alignas(32) std::array<std::uint32_t, fragments_at_once> texel_green;

    PixelColour colour(std::size_t i) const {
        return {static_cast<std::uint16_t>(red_and_blue[i]), static_cast<std::uint16_t>(green[i]),
            static_cast<std::uint16_t>(red_and_blue[i] >> 16U)};
    }

    /// 0..1.
    std::array<float, 3> texel(std::size_t i) const {
        const auto share = [](std::uint32_t value) { return static_cast<float>(value & 0xffffU) / 65535.0F; };
        return {share(texel_red_and_blue[i]), share(texel_green[i]), share(texel_red_and_blue[i] >> 16U)};
    }
};

/// What a triangle with a texture interpolates, at fragments.
class MeshValues {
public:
    using Value = SurfacePlanes::Value;

    /// `pixels`: numbers of pixels in the tile, as many as a register holds.
    HWY_INLINE MeshValues(const SurfacePlanes& planes, const glm::ivec2& tile_px, const std::uint16_t* pixels)
        : planes_(planes) {
        static_assert(tile_width == 64);
        const auto pixel = hn::PromoteTo(FragmentWhole(), hn::LoadU(hn::Rebind<std::uint16_t, Fragment>(), pixels));
        const auto place = [](FragmentWholes in_tile, std::int32_t from) HWY_ATTR {
            return hn::ConvertTo(Fragment(), hn::Add(in_tile, hn::Set(FragmentWhole(), from)));
        };
        column_ = place(hn::And(pixel, hn::Set(FragmentWhole(), tile_width - 1)), tile_px.x - planes.first_px.x);
        row_ = place(hn::ShiftRight<6>(pixel), tile_px.y - planes.first_px.y);
        w_ = hn::Div(each(1.0F), clamped(Value::InverseW, plane(Value::InverseW)));
    }

    HWY_INLINE FragmentReal at(Value value) const { return clamped(value, hn::Mul(plane(value), w_)); }

    /// How a value that is `here` changes to the next column, and to the next row.
    HWY_INLINE std::array<FragmentReal, 2> steps(Value value, FragmentReal here) const {
        const auto i = static_cast<std::size_t>(value);
        const auto step = [&](const std::array<float, SurfacePlanes::count>& per_px) HWY_ATTR {
            return hn::Mul(hn::Sub(each(per_px[i]), hn::Mul(here, each(per_px[0]))), w_);
        };
        return {step(planes_.per_x), step(planes_.per_y)};
    }

private:
    HWY_INLINE FragmentReal plane(Value value) const {
        const auto i = static_cast<std::size_t>(value);
        const auto in_row = hn::Add(each(planes_.base[i]), hn::Mul(row_, each(planes_.per_y[i])));
        return hn::Add(in_row, hn::Mul(column_, each(planes_.per_x[i])));
    }

    /// Beyond the triangle's edges, where only a pixel's samples are covered, no value is beyond those at the corners.
    HWY_INLINE FragmentReal clamped(Value value, FragmentReal raw) const {
        const auto i = static_cast<std::size_t>(value);
        return hn::Min(hn::Max(raw, each(planes_.min[i])), each(planes_.max[i]));
    }

    const SurfacePlanes& planes_;
    FragmentReal column_; ///< from the planes' first pixel
    FragmentReal row_;
    FragmentReal w_;
};

/// Finds what eight pixels, by their numbers in the tile, take of the texture and of the light.
HWY_INLINE void place_fragments(
    const SurfacePlanes& planes, const glm::ivec2& tile_px, const std::uint16_t* pixels, PlacedFragments& placed) {
    using Value = SurfacePlanes::Value;
    const FragmentBits bits;
    for (std::size_t i = 0; i < fragments_at_once; i += hn::Lanes(Fragment())) {
        const MeshValues values(planes, tile_px, pixels + i);
        const auto u = values.at(Value::U);
        const auto v = values.at(Value::V);
        const auto u_steps = values.steps(Value::U, u);
        const auto v_steps = values.steps(Value::V, v);
        MeshFootprint(*planes.texture, {u_steps[0], v_steps[0]}, {u_steps[1], v_steps[1]}).store(placed, i);
        hn::Store(u, Fragment(), placed.u.data() + i);
        hn::Store(v, Fragment(), placed.v.data() + i);
        const auto level = [&](Value value) HWY_ATTR { // 1/128
            return hn::BitCast(bits, hn::ConvertTo(FragmentWhole(), hn::Mul(values.at(value), each(128.0F))));
        };
        hn::Store(
            hn::Or(level(Value::Red), hn::ShiftLeft<16>(level(Value::Blue))), bits, placed.red_and_blue.data() + i);
        hn::Store(level(Value::Green), bits, placed.green.data() + i);
        hn::Store(hn::ConvertTo(FragmentWhole(), hn::Mul(values.at(Value::HazeShare), each(65535.0F))), FragmentWhole(),
            placed.haze_share.data() + i);
    }
}

/// Prefetches the texels of placed fragments: those at their places in the level of the first one.
HWY_INLINE void prefetch_texels(const MeshTexture& from, const PlacedFragments& placed) {
    constexpr std::int32_t in_cache = 64 * 64; // texels of a level that is not prefetched
    const MeshTexture::Level& level = from.levels[static_cast<std::size_t>(placed.level[0])];
    const std::int32_t count = level.width * level.height;
    if (count <= in_cache) { return; }
    const auto texel = [](FragmentReal place, std::int32_t size) HWY_ATTR {
        const auto within = hn::Mul(hn::Sub(place, hn::Floor(place)), each(static_cast<float>(size)));
        const auto left = hn::ConvertTo(FragmentWhole(), hn::Max(hn::Sub(within, each(0.5F)), hn::Zero(Fragment())));
        return hn::Min(hn::Max(left, hn::Zero(FragmentWhole())), hn::Set(FragmentWhole(), size - 1));
    };
    for (std::size_t i = 0; i < fragments_at_once; i += hn::Lanes(Fragment())) {
        const auto x = texel(hn::Load(Fragment(), placed.u.data() + i), level.width);
        const auto y = texel(hn::Load(Fragment(), placed.v.data() + i), level.height);
        alignas(32) std::array<std::int32_t, fragments_at_once> numbers;
        hn::Store(hn::Add(hn::Mul(y, hn::Set(FragmentWhole(), level.width)), x), FragmentWhole(), numbers.data());
        for (std::size_t k = 0; k < hn::Lanes(Fragment()); ++k) {
            hwy::Prefetch(level.texels + numbers[k]);
            hwy::Prefetch(level.texels + std::min(numbers[k] + level.width, count - 1));
        }
    }
}

/// Shades placed fragments of a triangle.
HWY_INLINE void shade_fragments(const SurfacePlanes& planes, const PlacedFragments& placed, ShadedFragments& shaded) {
    const FragmentHalves halves;
    const FragmentBits bits;
    const auto low_half = hn::Set(bits, 0xffffU);
    for (std::size_t i = 0; i < fragments_at_once; i += hn::Lanes(Fragment())) {
        const MeshTexels texel = sampled(*planes.texture, MeshFootprint(placed, i),
            hn::Load(Fragment(), placed.u.data() + i), hn::Load(Fragment(), placed.v.data() + i))
                                     .changed([](auto one) HWY_ATTR {
                                         return hn::Add(hn::Add(one, one), hn::ShiftRight<7>(one)); // of 32,640
                                     });
        const auto share = in_both_halves(hn::Load(FragmentWhole(), placed.haze_share.data() + i));
        const auto most = hn::MulHigh(hn::Set(halves, 255 * 128), hn::Not(share));
        const auto seen = [&](auto own, auto under_light, std::uint32_t haze) HWY_ATTR {
            const auto lit = hn::Min(hn::MulHigh(hn::BitCast(halves, under_light), own), most);
            const auto of_haze = hn::MulHigh(hn::BitCast(halves, hn::Set(bits, haze)), share);
            return hn::BitCast(bits, hn::ShiftRight<3>(hn::Add(hn::Add(lit, of_haze), hn::Set(halves, 4)))); // 1/16
        };
        const auto& haze = planes.haze;
        const auto red_and_blue = seen(texel.red_and_blue, hn::Load(bits, placed.red_and_blue.data() + i),
            haze[0] | std::uint32_t{haze[2]} << 16U);
        const auto green = seen(texel.green_and_alpha, hn::Load(bits, placed.green.data() + i), haze[1]);
        const auto green_and_alpha = hn::BitCast(bits, texel.green_and_alpha);
        hn::Store(red_and_blue, bits, shaded.red_and_blue.data() + i);
        hn::Store(hn::And(green, low_half), bits, shaded.green.data() + i);
        hn::Store(hn::ShiftRight<16>(green_and_alpha), bits, shaded.alpha.data() + i);
        hn::Store(hn::BitCast(bits, texel.red_and_blue), bits, shaded.texel_red_and_blue.data() + i);
        hn::Store(hn::And(green_and_alpha, low_half), bits, shaded.texel_green.data() + i);
    }
}

// -- Fragments of a triangle.

/// Places eight fragments of a triangle, from number `first` on.
HWY_INLINE void place_fragments(const TileTriangle& one, const TileJob& job, const TileFragments& fragments,
    std::size_t first, PlacedFragments& placed) {
    place_fragments(*one.surface, job.first_px, fragments.pixels.data() + first, placed);
    placed.triangle = &one;
    placed.count = std::min(fragments.count - first, fragments_at_once);
    std::copy_n(fragments.pixels.data() + first, fragments_at_once, placed.pixels.data());
    std::copy_n(fragments.samples.data() + first, fragments_at_once, placed.samples.data());
}

/// Repeats the last pixel up to a whole number of registers.
HWY_INLINE void fill_up(TileFragments& fragments) {
    std::fill_n(fragments.pixels.begin() + static_cast<std::ptrdiff_t>(fragments.count), fragments_at_once - 1,
        fragments.pixels[fragments.count - 1]);
}

/// Calls visit(number of the pixel, its samples, colour, alpha) for each of some placed fragments.
template <class Visit>
HWY_INLINE void shade_placed(const PlacedFragments& placed, const TileJob& job, const Visit& visit) {
    ShadedFragments shaded;
    const TileTriangle& one = *placed.triangle;
    shade_fragments(*one.surface, placed, shaded);
    for (std::size_t i = 0; i < placed.count; ++i) {
        const std::uint16_t pixel = placed.pixels[i];
        PixelColour colour = shaded.colour(i);
        if (one.triangle->fill == Fill::Lit) {
            colour = lit_colour_of(
                one, job, job.first_px + glm::ivec2(pixel % tile_width, pixel / tile_width), shaded.texel(i));
        }
        visit(std::size_t{pixel}, std::uint32_t{placed.samples[i]}, colour, shaded.alpha[i]);
    }
}

/// The same for each of the tile's fragments, which are of one triangle.
template <class Visit>
HWY_INLINE void for_each_fragment(
    const TileTriangle& one, const TileJob& job, TileFragments& fragments, const Visit& visit) {
    if (fragments.count == 0) { return; }
    fill_up(fragments);
    PlacedFragments placed;
    for (std::size_t first = 0; first < fragments.count; first += fragments_at_once) {
        place_fragments(one, job, fragments, first, placed);
        shade_placed(placed, job, visit);
    }
}

/// Adds the colours of fragments that wait for their samples.
HWY_NOINLINE void add_waiting(const TileJob& job, TileBuffer& buffer) {
    PlacedFragments& waiting = buffer.placed[buffer.waiting];
    if (waiting.count == 0) { return; }
    const bool counts_other = job.detail_texture != nullptr;
    shade_placed(waiting, job,
        [&](std::size_t pixel, std::uint32_t samples, const PixelColour& colour, std::uint32_t /*alpha*/) HWY_ATTR {
            const auto count = static_cast<std::uint32_t>(std::popcount(samples));
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint16_t& sum = buffer.sums[k][pixel];
                sum = static_cast<std::uint16_t>(sum + colour[k] * count);
            }
            if (counts_other) { buffer.sums[3][pixel] = static_cast<std::uint16_t>(buffer.sums[3][pixel] + count); }
        });
    waiting.count = 0;
}

/// Adds the colours of fragments; the last ones wait for add_waiting(). Sums do not depend on the order.
HWY_INLINE void add_fragments(const TileTriangle& one, const TileJob& job, TileBuffer& buffer) {
    TileFragments& fragments = buffer.fragments;
    if (fragments.count == 0) { return; }
    fill_up(fragments);
    for (std::size_t first = 0; first < fragments.count; first += fragments_at_once) {
        PlacedFragments& next = buffer.placed[1 - buffer.waiting];
        place_fragments(one, job, fragments, first, next);
        prefetch_texels(*one.surface->texture, next);
        add_waiting(job, buffer);
        buffer.waiting = 1 - buffer.waiting;
    }
}

/// Makes the pixels of a part of a strip fragments that have fresh samples.
HWY_INLINE void add_strip_part(std::size_t first_pixel, hn::Vec<Strip> fresh, TileFragments& fragments) {
    static_assert(part_px <= TileFragments::room);
    const auto is_fresh = hn::Ne(fresh, hn::Zero(Strip()));
    const auto pixels =
        hn::Add(hn::Set(Strip(), static_cast<std::uint16_t>(first_pixel)), lane_indices_from(Strip(), 0));
    hn::StoreU(hn::Compress(pixels, is_fresh), Strip(), fragments.pixels.data() + fragments.count);
    hn::StoreU(hn::Compress(fresh, is_fresh), Strip(), fragments.samples.data() + fragments.count);
    fragments.count += hn::CountTrue(Strip(), is_fresh);
}

/// Makes the free ones of a pixel's samples a fragment, and covers them.
HWY_INLINE void take_fragment(std::size_t pixel, std::uint32_t samples, TileBuffer& buffer) {
    const std::uint32_t before = buffer.covered[pixel];
    const std::uint32_t fresh = samples & ~before;
    buffer.fragments.add(pixel, fresh);
    buffer.fragments.count -= fresh == 0 ? 1 : 0;
    buffer.covered[pixel] = static_cast<std::uint16_t>(before | fresh);
    buffer.full[pixel / tile_width] |= std::uint64_t{(before | fresh) == 0xffffU} << pixel % tile_width;
}

HWY_INLINE void note_full_rows(const TileJob& job, int first_row, int last_row, TileBuffer& buffer) {
    for (int row = first_row; row <= last_row; ++row) {
        const bool is_full = (buffer.full[static_cast<std::size_t>(row)] & job.full_row()) == job.full_row();
        buffer.full_rows |= std::uint32_t{is_full} << row;
    }
}

/// Makes the free samples of TileBuffer::masks fragments, and covers them.
HWY_INLINE void take_fragments(const TileJob& job, TileBuffer& buffer) {
    buffer.fragments.count = 0;
    for_each_covered(job, buffer,
        [&](const glm::ivec2&, std::size_t pixel, std::uint32_t mask) HWY_ATTR { take_fragment(pixel, mask, buffer); });
    note_full_rows(job, buffer.coverage.first_row, buffer.coverage.last_row, buffer);
}

/// Paints a textured triangle without depth, holes and clip planes.
HWY_NOINLINE void paint_textured_mesh(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const Triangle& triangle = *one.triangle;
    TileBox box(triangle, job);
    if (!box.keep_free_rows(buffer)) { return; }
    TileFragments& fragments = buffer.fragments;
    fragments.count = 0;
    if (box.right - box.left < speck_px) {
        walk_speck(
            triangle, job, lanes, box, buffer,
            [&](auto /*column*/, int /*row*/, std::size_t pixel, std::uint32_t fresh) HWY_ATTR {
                fragments.add(pixel, fresh);
                fragments.count -= fresh == 0 ? 1 : 0;
            },
            [] {});
        add_fragments(one, job, buffer);
        return;
    }
    for (int left = box.left; left <= box.right; left += strip_px) {
        with_parts_of_strip(box, left, [&](auto parts) HWY_ATTR {
            const auto take = [&](int row, const auto& fresh) HWY_ATTR {
                for (std::size_t part = 0; part < fresh.size(); ++part) {
                    const auto first = static_cast<std::size_t>(row * tile_width + left) + part * part_px;
                    add_strip_part(first, fresh[part], fragments);
                }
            };
            walk_strip<decltype(parts)::value>(triangle, job, lanes, box, left, buffer, take, [] {});
        });
    }
    add_fragments(one, job, buffer);
}

// -- Holes: pixels in whose middle the texture's alpha is below the threshold.

/// Removes holes from fragments.
HWY_INLINE void remove_holes(const SurfacePlanes& planes, const glm::ivec2& tile_px, TileFragments& fragments) {
    const std::size_t count = fragments.count;
    if (count == 0) { return; }
    fill_up(fragments);
    const std::uint32_t threshold = planes.texture->threshold;
    fragments.count = 0;
    PlacedFragments placed;
    ShadedFragments shaded;
    for (std::size_t first = 0; first < count; first += fragments_at_once) {
        place_fragments(planes, tile_px, fragments.pixels.data() + first, placed);
        shade_fragments(planes, placed, shaded);
        for (std::size_t i = 0; i < std::min(count - first, fragments_at_once); ++i) {
            if (shaded.alpha[i] < threshold) { continue; }
            fragments.pixels[fragments.count] = fragments.pixels[first + i];
            fragments.samples[fragments.count++] = fragments.samples[first + i];
        }
    }
}

/// Removes holes from TileBuffer::masks.
HWY_NOINLINE void remove_holes(const TileTriangle& one, const TileJob& job, TileBuffer& buffer) {
    TileFragments& fragments = buffer.fragments;
    fragments.count = 0;
    for_each_covered(job, buffer,
        [&](const glm::ivec2&, std::size_t pixel, std::uint32_t mask) HWY_ATTR { fragments.add(pixel, mask); });
    const auto mask_of = [&](std::size_t pixel) -> std::uint16_t& {
        return buffer.masks[pixel / tile_width * TileBuffer::mask_row + pixel % tile_width];
    };
    for (std::size_t i = 0; i < fragments.count; ++i) { mask_of(fragments.pixels[i]) = 0; }
    remove_holes(*one.surface, job.first_px, fragments);
    for (std::size_t i = 0; i < fragments.count; ++i) { mask_of(fragments.pixels[i]) = fragments.samples[i]; }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
