// The colours of a texture along sixteen pixels of a triangle.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXELS_INL
#undef OCTANT_RASTER_TEXELS_INL
#else
#define OCTANT_RASTER_TEXELS_INL
#endif

#include "visuals/raster/tile_fill-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using Reals = hn::CappedTag<double, 4>;
constexpr std::size_t four_parts = 4 / hn::MaxLanes(Reals());

/// Four values of a corner or a pixel.
using Four = std::array<hn::Vec<Reals>, four_parts>;

template <class Of>
HWY_INLINE Four four(const Of& of) {
    Four result;
    for (std::size_t i = 0; i < four_parts; ++i) {
        result[i] = of(i);
    }
    return result;
}

HWY_INLINE hn::Vec<Reals> real(double value) {
    return hn::Set(Reals(), value);
}

/// What a textured triangle has at a pixel: its place in texels, light left and share of haze.
struct TexturePoint {
    double w;
    Four value;
};

/// The planes of a textured triangle, its four values next to each other.
struct TexturePlanes {
    RealPlane by_w;
    Four base;
    Four per_x;
    Four per_y;

    HWY_INLINE explicit TexturePlanes(const TriangleExtra& extra)
        : by_w(extra.by_w[4])
        , base(values_of(extra, &RealPlane::base))
        , per_x(values_of(extra, &RealPlane::per_x))
        , per_y(values_of(extra, &RealPlane::per_y)) {}

    HWY_INLINE TexturePoint at(double column, double row) const {
        const double w = 1.0 / std::max(by_w.at(column, row), 1e-30);
        const auto x = real(column);
        const auto y = real(row);
        return {w, four([&](std::size_t i) HWY_ATTR {
                    const auto across = hn::Add(base[i], hn::Mul(per_x[i], x));
                    return hn::Mul(hn::Add(across, hn::Mul(per_y[i], y)), real(w));
                })};
    }

private:
    static HWY_INLINE Four values_of(const TriangleExtra& extra, double RealPlane::*part) {
        alignas(32) std::array<double, 4> values;
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = extra.by_w[i].*part;
        }
        return four([&](std::size_t i)
                        HWY_ATTR { return hn::Load(Reals(), &values[i * hn::MaxLanes(Reals())]); });
    }
};

/// Values of 32 bits along a block.
struct BlockWalk {
    alignas(16) std::array<std::int32_t, 4> first;
    alignas(16) std::array<std::int32_t, 4> per_px;

    /// `share`: one over the pixels between both.
    HWY_INLINE BlockWalk(const Four& from, const Four& to, double share) {
        const hn::Rebind<std::int32_t, Reals> whole;
        for (std::size_t i = 0; i < four_parts; ++i) {
            const std::size_t at = i * hn::MaxLanes(Reals());
            const auto step = hn::Mul(hn::Sub(to[i], from[i]), real(share));
            hn::StoreU(hn::DemoteTo(whole, from[i]), whole, &first[at]);
            hn::StoreU(hn::DemoteTo(whole, step), whole, &per_px[at]);
        }
    }
};

/// How many texels of the finest level a pixel is wide, squared.
HWY_INLINE double
footprint2(const TexturePlanes& planes, const std::array<TexturePoint, 2>& ends, double share) {
    const auto& [here, end] = ends;
    const Reals reals;
    // The first two values are the place.
    const auto squared = [&](hn::Vec<Reals> step) HWY_ATTR {
        const auto squares = hn::Mul(step, step);
        return hn::GetLane(hn::Add(squares, hn::Reverse2(reals, squares)));
    };
    const auto across = hn::Mul(hn::Sub(end.value[0], here.value[0]), real(share));
    const auto down = hn::Mul(
        hn::Sub(planes.per_y[0], hn::Mul(here.value[0], real(planes.by_w.per_y))), real(here.w));
    return std::max(squared(across), squared(down));
}

/// Red, green and blue of a block's pixels, 1/128 level, 32,640 at most.
struct BlockColours {
    alignas(32) std::array<std::array<std::uint16_t, block_px>, 3> level;
};

using Texels = hn::CappedTag<std::uint32_t, block_px>;
using TexelHalves = hn::Repartition<std::uint16_t, Texels>;

/// Two bytes of each texel, those that lie `shift` bits up and sixteen further.
template <int shift>
HWY_INLINE hn::Vec<TexelHalves> two_bytes(hn::Vec<Texels> texels) {
    const auto low = shift == 0 ? texels : hn::ShiftRight<shift>(texels);
    return hn::BitCast(TexelHalves(), hn::And(low, hn::Set(Texels(), 0x00ff00ffU)));
}

/// The same sixteen bits in both halves.
HWY_INLINE hn::Vec<TexelHalves> in_both_halves(hn::Vec<Texels> value) {
    return hn::BitCast(TexelHalves(), hn::Or(value, hn::ShiftLeft<16>(value)));
}

/// Texels around places: those left below, right below, left above and right above.
struct TexelSquares {
    std::array<hn::Vec<Texels>, 4> corner;
    hn::Vec<TexelHalves> right; ///< share of the right ones, 2^-16
    hn::Vec<TexelHalves> up;    ///< share of the upper ones, 1/128

    /// `x`, `y`: places in 2^-16 texel, at least a texel within the rim above and right.
    HWY_INLINE TexelSquares(
        const GroundImage::Level& level,
        hn::Vec<hn::RebindToSigned<Texels>> x,
        hn::Vec<hn::RebindToSigned<Texels>> y) {
        const Texels texels;
        const hn::RebindToSigned<Texels> sign;
        const auto first = hn::Add(
            hn::Mul(hn::ShiftRight<16>(y), hn::Set(sign, level.width)), hn::ShiftRight<16>(x));
        load_neighbours(level, first, corner[0], corner[1]);
        load_neighbours(level, hn::Add(first, hn::Set(sign, level.width)), corner[2], corner[3]);
        const auto part = [&](auto place) HWY_ATTR {
            return hn::And(hn::BitCast(texels, place), hn::Set(texels, 0xffffU));
        };
        right = in_both_halves(part(x));
        up = in_both_halves(hn::ShiftRight<9>(part(y)));
    }

    /// Texels by their numbers in the level, and those right of them: both are loaded at once.
    static HWY_INLINE void load_neighbours(
        const GroundImage::Level& level,
        hn::Vec<hn::RebindToSigned<Texels>> number,
        hn::Vec<Texels>& left_ones,
        hn::Vec<Texels>& right_ones) {
        const Texels texels;
        const hn::Repartition<std::uint64_t, Texels> pairs;
        const hn::RebindToSigned<decltype(pairs)> offsets;
        const hn::Half<hn::RebindToSigned<Texels>> half;
        const auto* const from = reinterpret_cast<const std::uint64_t*>(level.texels.data());
        const auto load = [&](auto some) HWY_ATTR {
            const auto bytes = hn::ShiftLeft<2>(hn::PromoteTo(offsets, some));
            return hn::BitCast(texels, hn::GatherOffset(pairs, from, bytes));
        };
        const auto low = load(hn::LowerHalf(half, number));
        const auto high = load(hn::UpperHalf(half, number));
        left_ones = hn::ConcatEven(texels, high, low);
        right_ones = hn::ConcatOdd(texels, high, low);
    }

    /// Two of their colours, mixed.
    template <int shift>
    HWY_INLINE hn::Vec<Texels> mixed() const {
        const TexelHalves halves;
        const auto column = [&](std::size_t side) HWY_ATTR {
            return hn::Add(
                hn::Mul(two_bytes<shift>(corner[side]), hn::Sub(hn::Set(halves, 128), up)),
                hn::Mul(two_bytes<shift>(corner[side + 2]), up));
        };
        // The left texel has what the right one leaves of 65,535.
        return hn::BitCast(
            Texels(),
            hn::Add(hn::MulHigh(column(0), hn::Not(right)), hn::MulHigh(column(1), right)));
    }
};

/// Places of a level along a block, 2^-16 texel: at its first pixel and from each to the next.
struct TexelLine {
    std::array<std::int32_t, 2> first;
    std::array<std::int32_t, 2> per_px;
};

/// A level's colours along a block. Places beyond the texture's rim have the rim's.
HWY_INLINE void
sample_line(const GroundImage::Level& level, const TexelLine& line, BlockColours& to) {
    const hn::RebindToSigned<Texels> sign;
    const hn::Rebind<std::uint16_t, Texels> halves;
    for (std::size_t i = 0; i < block_px; i += hn::MaxLanes(Texels())) {
        const auto steps = counting_from(sign, i);
        const auto place = [&](std::size_t k, int size) HWY_ATTR {
            const auto at = hn::Add(
                hn::Set(sign, line.first[k]), hn::Mul(steps, hn::Set(sign, line.per_px[k])));
            return hn::Min(hn::Max(at, hn::Zero(sign)), hn::Set(sign, (size - 1) * 65536 - 1));
        };
        const TexelSquares around(level, place(0, level.width), place(1, level.height));
        const auto store = [&](std::size_t k, hn::Vec<Texels> values) HWY_ATTR {
            hn::StoreU(hn::DemoteTo(halves, hn::BitCast(sign, values)), halves, &to.level[k][i]);
        };
        const auto red_blue = around.mixed<0>();
        const auto green = around.mixed<8>();
        const auto lower_half = hn::Set(Texels(), 0xffffU);
        store(0, hn::And(red_blue, lower_half));
        store(1, hn::And(green, lower_half));
        store(2, hn::ShiftRight<16>(red_blue));
    }
}

/// Steps of a level's places, 2^-16 texel, in a texel of the finest level.
HWY_INLINE double texel_scale(std::size_t level) {
    return 65536.0 / static_cast<double>(std::uint64_t{1} << level);
}

/// The texture's colours along a block, from one of its levels.
HWY_INLINE void sample_texture(
    const GroundImage& image,
    std::size_t number,
    const std::array<TexturePoint, 2>& ends,
    double share,
    BlockColours& to) {
    const GroundImage::Level& level = image.levels()[number];
    const double scale = texel_scale(number);
    const auto places = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto place =
                hn::Sub(hn::Mul(hn::Add(end.value[i], real(0.5)), real(scale)), real(32768.0));
            const auto limit = hn::Load(Reals(), &level.last_place[i * hn::MaxLanes(Reals())]);
            return hn::Min(hn::Max(place, real(0.0)), limit);
        });
    };
    const BlockWalk walk(places(ends[0]), places(ends[1]), share);
    sample_line(level, {{walk.first[0], walk.first[1]}, {walk.per_px[0], walk.per_px[1]}}, to);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
