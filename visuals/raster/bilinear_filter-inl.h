// The colours of a texture's level at places: four texels each, mixed in whole numbers. Included once for each
// instruction set.
#if defined(OCTANT_RASTER_TEXEL_MIX_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXEL_MIX_INL
#undef OCTANT_RASTER_TEXEL_MIX_INL
#else
#define OCTANT_RASTER_TEXEL_MIX_INL
#endif

#include "visuals/raster/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The lower halves of both registers' values in turn: those of `even` in even lanes.
template <class Halves, class V>
HWY_INLINE hn::Vec<Halves> lower_halves(V even, V odd) {
    const Halves halves;
    return hn::OddEven(hn::BitCast(halves, hn::ShiftLeft<16>(odd)), hn::BitCast(halves, even));
}

template <class Halves, class V>
HWY_INLINE hn::Vec<Halves> upper_halves(V even, V odd) {
    const Halves halves;
    return hn::OddEven(hn::BitCast(halves, odd), hn::BitCast(halves, hn::ShiftRight<16>(even)));
}

/// How four corners are mixed, sixteen bits at a time.
template <class Halves>
struct BilinearWeights {
    hn::Vec<Halves> right; ///< share of the right ones, 2^-16
    hn::Vec<Halves> up;    ///< share of the upper ones, 1/128

    /// By the lower halves of places, 2^-16 texel.
    template <class V>
    HWY_INLINE BilinearWeights(V even_x, V odd_x, V even_y, V odd_y)
        : right(lower_halves<Halves>(even_x, odd_x)), up(hn::ShiftRight<9>(lower_halves<Halves>(even_y, odd_y))) {}

    /// Bytes, left below, right below, left above and right above; 1/128.
    HWY_INLINE hn::Vec<Halves> mixed(const std::array<hn::Vec<Halves>, 4>& texels_2x2) const {
        const auto column = [&](std::size_t side) HWY_ATTR {
            const auto down = hn::Sub(hn::Set(Halves(), 128), up);
            return hn::Add(hn::Mul(texels_2x2[side], down), hn::Mul(texels_2x2[side + 2], up));
        };
        // The left texel has what the right one leaves of 65,535.
        return hn::Add(hn::MulHigh(column(0), hn::Not(right)), hn::MulHigh(column(1), right));
    }
};

/// A level as its texels are found.
template <class Texels>
struct TexelGrid {
    using TexelCoords = hn::Vec<hn::RebindToSigned<Texels>>;

    const std::uint32_t* texels;
    const std::uint32_t* above; ///< the row above the first one
    TexelCoords stride;
    TexelCoords last_x; ///< a step before the rim, 2^-16 texel
    TexelCoords last_y;

    HWY_INLINE explicit TexelGrid(const LitGroundTexture::MipLevel& level)
        : texels(level.texels.data()), above(level.texels.data() + level.stride) {
        const hn::RebindToSigned<Texels> sign;
        stride = hn::Set(sign, level.stride);
        last_x = hn::Set(sign, (level.width - 1) * 65536 - 1);
        last_y = hn::Set(sign, (level.height - 1) * 65536 - 1);
    }
};

/// Texels around places: those left below, right below, left above and right above.
template <class Texels>
struct TexelQuads {
    using TexelCoords = hn::Vec<hn::RebindToSigned<Texels>>;

    std::array<hn::Vec<Texels>, 4> texels_2x2;

    /// `x`, `y`: places in 2^-16 texel, at least a texel within the rim above and right.
    HWY_INLINE TexelQuads(const TexelGrid<Texels>& grid, TexelCoords x, TexelCoords y) {
        const auto number = hn::Add(hn::Mul(hn::ShiftRight<16>(y), grid.stride), hn::ShiftRight<16>(x));
        load_neighbours(grid.texels, number, texels_2x2[0], texels_2x2[1]);
        load_neighbours(grid.above, number, texels_2x2[2], texels_2x2[3]);
    }

#if HWY_TARGET == HWY_AVX2

    /// Texels by their numbers, and those right of them: both are loaded at once. One by one they come faster than by
    /// the processor's own gathering.
    static HWY_INLINE void load_neighbours(
        const std::uint32_t* from, TexelCoords number, hn::Vec<Texels>& left_ones, hn::Vec<Texels>& right_ones) {
        const __m128i low = _mm256_castsi256_si128(number.raw);
        const __m128i high = _mm256_extracti128_si256(number.raw, 1);
        // The first two of each four, then the others.
        const __m256 front = texels_of(from, _mm_cvtsi128_si64(low), _mm_cvtsi128_si64(high));
        const __m256 back = texels_of(from, _mm_extract_epi64(low, 1), _mm_extract_epi64(high, 1));
        left_ones.raw = _mm256_castps_si256(_mm256_shuffle_ps(front, back, 0x88));
        right_ones.raw = _mm256_castps_si256(_mm256_shuffle_ps(front, back, 0xdd));
    }

private:
    /// By two numbers of 32 bits each.
    static HWY_INLINE __m256 texels_of(const std::uint32_t* from, std::int64_t low, std::int64_t high) {
        return _mm256_set_m128(
            texels_of(from, static_cast<std::uint64_t>(high)), texels_of(from, static_cast<std::uint64_t>(low)));
    }

    static HWY_INLINE __m128 texels_of(const std::uint32_t* from, std::uint64_t two) {
        const auto* const first = reinterpret_cast<const __m128i*>(from + (two & 0xffffffff));
        const auto* const second = reinterpret_cast<const __m64*>(from + (two >> 32U));
        return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(first)), second);
    }

#else

    /// Texels by their numbers, and those right of them: both are loaded at once.
    static HWY_INLINE void load_neighbours(
        const std::uint32_t* from, TexelCoords number, hn::Vec<Texels>& left_ones, hn::Vec<Texels>& right_ones) {
        const Texels texels;
        const hn::Repartition<std::uint64_t, Texels> pairs;
        const hn::RebindToSigned<decltype(pairs)> offsets;
        const auto load = [&](auto some) HWY_ATTR {
            const auto bytes = hn::BitCast(offsets, hn::ShiftLeft<2>(some));
            return hn::GatherOffset(pairs, reinterpret_cast<const std::uint64_t*>(from), bytes);
        };
        const auto numbers = hn::BitCast(pairs, number);
        const auto even = load(hn::And(numbers, hn::Set(pairs, std::uint64_t{0xffffffff})));
        const auto odd = load(hn::ShiftRight<32>(numbers));
        left_ones = hn::OddEven(hn::BitCast(texels, hn::ShiftLeft<32>(odd)), hn::BitCast(texels, even));
        right_ones = hn::OddEven(hn::BitCast(texels, odd), hn::BitCast(texels, hn::ShiftRight<32>(even)));
    }

#endif
};

/// Red, green and blue, 1/128 level, 32,640 at most.
template <class Halves>
using FilteredColours = std::array<hn::Vec<Halves>, 3>;

template <class Halves>
using TexelsOf = hn::Repartition<std::uint32_t, Halves>;

/// A level's colours at places, 2^-16 texel, of pixels in even lanes and in odd ones. Places beyond the level's rim
/// have the rim's.
template <class Halves, class V>
HWY_INLINE FilteredColours<Halves> filter_bilinear(
    const TexelGrid<TexelsOf<Halves>>& grid, V even_x, V even_y, V odd_x, V odd_y) {
    using Texels = TexelsOf<Halves>;
    const hn::RebindToSigned<Texels> sign;
    const Halves halves;
    const auto within = [&](V place, V last) HWY_ATTR { return hn::Min(hn::Max(place, hn::Zero(sign)), last); };
    even_x = within(even_x, grid.last_x);
    odd_x = within(odd_x, grid.last_x);
    even_y = within(even_y, grid.last_y);
    odd_y = within(odd_y, grid.last_y);
    const TexelQuads<Texels> even(grid, even_x, even_y);
    const TexelQuads<Texels> odd(grid, odd_x, odd_y);
    const auto red_and_blue = [&](const TexelQuads<Texels>& of, V x, V y) HWY_ATTR {
        std::array<hn::Vec<Halves>, 4> texels_2x2;
        for (std::size_t i = 0; i < texels_2x2.size(); ++i) {
            texels_2x2[i] = hn::BitCast(halves, hn::And(of.texels_2x2[i], hn::Set(Texels(), 0x00ff00ffU)));
        }
        const BilinearWeights<Halves> weights(x, x, y, y);
        return hn::BitCast(Texels(), weights.mixed(texels_2x2));
    };
    std::array<hn::Vec<Halves>, 4> green;
    for (std::size_t i = 0; i < green.size(); ++i) {
        green[i] = hn::ShiftRight<8>(lower_halves<Halves>(even.texels_2x2[i], odd.texels_2x2[i]));
    }
    const auto of_even = red_and_blue(even, even_x, even_y);
    const auto of_odd = red_and_blue(odd, odd_x, odd_y);
    return {lower_halves<Halves>(of_even, of_odd), BilinearWeights<Halves>(even_x, odd_x, even_y, odd_y).mixed(green),
        upper_halves<Halves>(of_even, of_odd)};
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
