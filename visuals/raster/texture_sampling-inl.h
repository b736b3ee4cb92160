// Samples of the ground's texture: the bilinear filter in whole numbers, then the choice of mip levels and the fetch of
// texels. Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURE_SAMPLING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURE_SAMPLING_INL
#undef OCTANT_RASTER_TEXTURE_SAMPLING_INL
#else
#define OCTANT_RASTER_TEXTURE_SAMPLING_INL
#endif

#include "visuals/raster/coverage-inl.h"
#include "visuals/raster/tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// -- The bilinear filter: four texels each, mixed in whole numbers.

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

// -- The colours of a texture along sixteen pixels of a triangle.

using Reals = hn::CappedTag<double, 4>;
constexpr std::size_t four_parts = 4 / hn::MaxLanes(Reals());

/// Four values of a corner or a pixel.
using Four = std::array<hn::Vec<Reals>, four_parts>;

template <class Of>
HWY_INLINE Four four(const Of& of) {
    Four result;
    for (std::size_t i = 0; i < four_parts; ++i) { result[i] = of(i); }
    return result;
}

HWY_INLINE hn::Vec<Reals> real(double value) { return hn::Set(Reals(), value); }

/// What a textured triangle has at a pixel: its place in texels, light left and share of haze.
struct TexturePoint {
    double w;
    Four value;
};

/// The planes of a textured triangle, its four values next to each other.
struct TexturePlanes {
    AttributePlane over_w;
    Four base;
    Four per_x;
    Four per_y;

    HWY_INLINE explicit TexturePlanes(const TriangleExtra& extra)
        : over_w(extra.over_w[4]), base(values_of(extra, &AttributePlane::base)),
          per_x(values_of(extra, &AttributePlane::per_x)), per_y(values_of(extra, &AttributePlane::per_y)) {}

    HWY_INLINE TexturePoint at(double column, double row) const {
        const double w = 1.0 / std::max(over_w.at(column, row), 1e-30);
        const auto x = real(column);
        const auto y = real(row);
        return {w, four([&](std::size_t i) HWY_ATTR {
                    const auto across = hn::Add(base[i], hn::Mul(per_x[i], x));
                    return hn::Mul(hn::Add(across, hn::Mul(per_y[i], y)), real(w));
                })};
    }

private:
    static HWY_INLINE Four values_of(const TriangleExtra& extra, double AttributePlane::*part) {
        alignas(32) std::array<double, 4> values;
        for (std::size_t i = 0; i < values.size(); ++i) { values[i] = extra.over_w[i].*part; }
        return four([&](std::size_t i) HWY_ATTR { return hn::Load(Reals(), &values[i * hn::MaxLanes(Reals())]); });
    }
};

/// Values of 32 bits along a block.
struct BlockStepper {
    alignas(16) std::array<std::int32_t, 4> first;
    alignas(16) std::array<std::int32_t, 4> per_px;

    /// `share`: one over the pixels between both.
    HWY_INLINE BlockStepper(const Four& from, const Four& to, double share) {
        const hn::Rebind<std::int32_t, Reals> whole;
        for (std::size_t i = 0; i < four_parts; ++i) {
            const std::size_t at = i * hn::MaxLanes(Reals());
            const auto step = hn::Mul(hn::Sub(to[i], from[i]), real(share));
            hn::StoreU(hn::DemoteTo(whole, from[i]), whole, &first[at]);
            hn::StoreU(hn::DemoteTo(whole, step), whole, &per_px[at]);
        }
    }
};

HWY_INLINE TexelDerivatives texel_derivatives(
    const TexturePlanes& planes, const std::array<TexturePoint, 2>& ends, double share) {
    const auto& [here, end] = ends;
    // The first two values are the place.
    const auto place = [](hn::Vec<Reals> step) HWY_ATTR {
        alignas(32) std::array<double, 4> values;
        hn::Store(step, Reals(), values.data());
        return std::array{values[0], values[1]};
    };
    const auto turned = hn::Mul(here.value[0], real(planes.over_w.per_y));
    return {place(hn::Mul(hn::Sub(end.value[0], here.value[0]), real(share))),
        place(hn::Mul(hn::Sub(planes.per_y[0], turned), real(here.w)))};
}

/// Red, green and blue of a block's pixels, 1/128 level, 32,640 at most.
struct BlockColours {
    alignas(32) std::array<std::array<std::uint16_t, block_px>, 3> level;
};

/// Places of a level along a block, 2^-16 texel: at its first pixel and from each to the next.
struct TexelSpan {
    std::array<std::int32_t, 2> first;
    std::array<std::int32_t, 2> per_px;
};

/// Steps of a level's places, 2^-16 texel, in a texel of the finest level.
HWY_INLINE double texel_scale(std::size_t level) { return 65536.0 / static_cast<double>(std::uint64_t{1} << level); }

/// The places of a level that a pixel's colour is the mean of, 2^-16 texel.
struct Probes {
    int count;
    std::uint16_t share;              ///< 2^-16
    std::array<std::int32_t, 2> last; ///< from the pixel's middle
    std::array<std::int32_t, 2> step; ///< to the next one

    HWY_INLINE Probes(const MipSelection& levels, std::size_t level)
        : count(levels.probes), share(static_cast<std::uint16_t>(65535 / levels.probes)) {
        const double scale = texel_scale(level);
        for (std::size_t k = 0; k < 2; ++k) {
            last[k] = static_cast<std::int32_t>(static_cast<double>(levels.reach[k]) * scale);
            step[k] = count > 1 ? 2 * last[k] / (count - 1) : 0;
        }
    }

    /// The mean of colours_at(how far from the pixel's middle).
    template <class Halves, class ColoursAt>
    HWY_INLINE FilteredColours<Halves> mean(const ColoursAt& colours_at) const {
        FilteredColours<Halves> sum = colours_at(-last[0], -last[1]);
        if (count == 1) { return sum; }
        const auto part = hn::Set(Halves(), share);
        for (auto& colour : sum) { colour = hn::MulHigh(colour, part); }
        for (int k = 1; k < count; ++k) {
            const FilteredColours<Halves> one = colours_at(k * step[0] - last[0], k * step[1] - last[1]);
            for (std::size_t i = 0; i < sum.size(); ++i) { sum[i] = hn::Add(sum[i], hn::MulHigh(one[i], part)); }
        }
        return sum;
    }
};

/// A level's colours along a block.
HWY_INLINE void sample_line(
    const LitGroundTexture::MipLevel& level, const TexelSpan& line, const Probes& probes, BlockColours& to) {
    const Pixels pixels;
    const hn::RebindToSigned<hn::Repartition<std::uint32_t, Pixels>> sign;
    const TexelGrid<TexelsOf<Pixels>> grid(level);
    for (std::size_t i = 0; i < block_px; i += hn::MaxLanes(pixels)) {
        const auto even_px = hn::ShiftLeft<1>(lane_indices_from(sign, i / 2));
        const auto even = [&](std::size_t k) HWY_ATTR {
            return hn::Add(hn::Set(sign, line.first[k]), hn::Mul(even_px, hn::Set(sign, line.per_px[k])));
        };
        const auto next = [&](std::size_t k) HWY_ATTR { return hn::Add(even(k), hn::Set(sign, line.per_px[k])); };
        const std::array x{even(0), next(0)};
        const std::array y{even(1), next(1)};
        const auto colours = probes.mean<Pixels>([&](std::int32_t dx, std::int32_t dy) HWY_ATTR {
            const auto off_x = hn::Set(sign, dx);
            const auto off_y = hn::Set(sign, dy);
            return filter_bilinear<Pixels>(
                grid, hn::Add(x[0], off_x), hn::Add(y[0], off_y), hn::Add(x[1], off_x), hn::Add(y[1], off_y));
        });
        for (std::size_t k = 0; k < colours.size(); ++k) { hn::StoreU(colours[k], pixels, &to.level[k][i]); }
    }
}

/// The texture's colours along a block, from one of its levels.
HWY_INLINE void sample_texture(const LitGroundTexture& image, std::size_t number, const MipSelection& chosen,
    const std::array<TexturePoint, 2>& ends, double share, BlockColours& to) {
    const LitGroundTexture::MipLevel& level = image.levels()[number];
    const double scale = texel_scale(number);
    const auto places = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto place = hn::Sub(hn::Mul(hn::Add(end.value[i], real(0.5)), real(scale)), real(32768.0));
            const auto limit = hn::Load(Reals(), &level.last_place[i * hn::MaxLanes(Reals())]);
            return hn::Min(hn::Max(place, real(0.0)), limit);
        });
    };
    const BlockStepper walk(places(ends[0]), places(ends[1]), share);
    sample_line(level, {{walk.first[0], walk.first[1]}, {walk.per_px[0], walk.per_px[1]}}, Probes(chosen, number), to);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
