// Textured triangles, all by one span routine: first the coverage of a strip, then the colours of windows of eight
// pixels. In a window texture coordinates, light and haze are planes. Planes of a triangle in perspective are fitted to
// parts of the strip: to all of its rows, to a few of them or to single windows, as few parts as the error allows. In
// this order: the bilinear filter; windows that wait for colours; planes over windows; colours; triangles. Included
// once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURED_TRIANGLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURED_TRIANGLE_INL
#undef OCTANT_RASTER_TEXTURED_TRIANGLE_INL
#else
#define OCTANT_RASTER_TEXTURED_TRIANGLE_INL
#endif

#include "visuals/raster/strip_coverage-inl.h"
#include "visuals/raster/tile.h"
#include "visuals/raster/triangle_planes.h"

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

// -- The bilinear filter: the four texels around a place, mixed in whole numbers.

using Texels = hn::Repartition<std::uint32_t, Strip>;
using TexelsSigned = hn::RebindToSigned<Texels>;
using TexelPlaces = hn::Vec<TexelsSigned>; ///< 2^-16 texel

/// Red, green and blue of the pixels of a register, 1/128 level, 32,640 at most.
using Colours = std::array<hn::Vec<Strip>, 3>;

/// The places of a register's pixels in a level: of those in even lanes, then of those in odd lanes.
struct TextureCoords {
    std::array<TexelPlaces, 2> x;
    std::array<TexelPlaces, 2> y;
};

/// The lower halves of both registers' values in turn: those of `even` in even lanes.
template <class V>
HWY_INLINE hn::Vec<Strip> lower_halves(V even, V odd) {
    return hn::OddEven(hn::BitCast(Strip(), hn::ShiftLeft<16>(odd)), hn::BitCast(Strip(), even));
}

template <class V>
HWY_INLINE hn::Vec<Strip> upper_halves(V even, V odd) {
    return hn::OddEven(hn::BitCast(Strip(), odd), hn::BitCast(Strip(), hn::ShiftRight<16>(even)));
}

/// How four texels are mixed, sixteen bits at a time.
struct BilinearWeights {
    hn::Vec<Strip> right; ///< share of the right ones, 2^-16
    hn::Vec<Strip> up;    ///< share of the upper ones, 1/128

    HWY_INLINE BilinearWeights(TexelPlaces even_x, TexelPlaces odd_x, TexelPlaces even_y, TexelPlaces odd_y)
        : right(lower_halves(even_x, odd_x)), up(hn::ShiftRight<9>(lower_halves(even_y, odd_y))) {}

    /// Bytes, left below, right below, left above and right above; 1/128.
    HWY_INLINE hn::Vec<Strip> mixed(const std::array<hn::Vec<Strip>, 4>& texels_2x2) const {
        const auto column = [&](std::size_t side) HWY_ATTR {
            const auto down = hn::Sub(hn::Set(Strip(), 128), up);
            return hn::Add(hn::Mul(texels_2x2[side], down), hn::Mul(texels_2x2[side + 2], up));
        };
        // The left texel has what the right one leaves of 65,535.
        return hn::Add(hn::MulHigh(column(0), hn::Not(right)), hn::MulHigh(column(1), right));
    }
};

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2

/// Eight texels by their numbers, and those right of them: both are loaded at once. One by one they come faster than by
/// the processor's own gathering.
struct TexelPairs {
    __m256i left;
    __m256i right;

    HWY_INLINE TexelPairs(const std::uint32_t* from, __m256i numbers) {
        const __m128i low = _mm256_castsi256_si128(numbers);
        const __m128i high = _mm256_extracti128_si256(numbers, 1);
        // The first two of each four, then the others.
        const __m256 front = texels_of(from, _mm_cvtsi128_si64(low), _mm_cvtsi128_si64(high));
        const __m256 back = texels_of(from, _mm_extract_epi64(low, 1), _mm_extract_epi64(high, 1));
        left = _mm256_castps_si256(_mm256_shuffle_ps(front, back, 0x88));
        right = _mm256_castps_si256(_mm256_shuffle_ps(front, back, 0xdd));
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
};

#endif

/// Access to the texels of a level.
struct TexelGrid {
    const std::uint32_t* texels;
    const std::uint32_t* above; ///< the row above the first one
    TexelPlaces stride;
    TexelPlaces last_x; ///< a step before the rim, 2^-16 texel
    TexelPlaces last_y;

    HWY_INLINE explicit TexelGrid(const LitGroundTexture::MipLevel& level)
        : texels(level.texels.data()), above(level.texels.data() + level.stride) {
        stride = hn::Set(TexelsSigned(), level.stride);
        last_x = hn::Set(TexelsSigned(), (level.width - 1) * 65536 - 1);
        last_y = hn::Set(TexelsSigned(), (level.height - 1) * 65536 - 1);
    }
};

/// Texels around places: those left below, right below, left above and right above.
struct TexelQuads {
    std::array<hn::Vec<Texels>, 4> texels_2x2;

    /// `x`, `y`: places in 2^-16 texel, at least a texel within the rim above and right.
    HWY_INLINE TexelQuads(const TexelGrid& grid, TexelPlaces x, TexelPlaces y) {
        const auto number = hn::Add(hn::Mul(hn::ShiftRight<16>(y), grid.stride), hn::ShiftRight<16>(x));
        load_neighbours(grid.texels, number, texels_2x2[0], texels_2x2[1]);
        load_neighbours(grid.above, number, texels_2x2[2], texels_2x2[3]);
    }

#if HWY_TARGET == HWY_AVX2

    /// Texels by their numbers, and those right of them: both are loaded at once.
    static HWY_INLINE void load_neighbours(
        const std::uint32_t* from, TexelPlaces number, hn::Vec<Texels>& left_ones, hn::Vec<Texels>& right_ones) {
        const TexelPairs pairs(from, number.raw);
        left_ones.raw = pairs.left;
        right_ones.raw = pairs.right;
    }

#else

    /// Texels by their numbers, and those right of them: both are loaded at once.
    static HWY_INLINE void load_neighbours(
        const std::uint32_t* from, TexelPlaces number, hn::Vec<Texels>& left_ones, hn::Vec<Texels>& right_ones) {
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

/// A level's colours at places. Places beyond the level's rim have the colours of the rim.
HWY_INLINE Colours filter_bilinear(const TexelGrid& grid, const TextureCoords& places) {
    const auto within = [&](TexelPlaces place, TexelPlaces last)
                            HWY_ATTR { return hn::Min(hn::Max(place, hn::Zero(TexelsSigned())), last); };
    const auto even_x = within(places.x[0], grid.last_x);
    const auto odd_x = within(places.x[1], grid.last_x);
    const auto even_y = within(places.y[0], grid.last_y);
    const auto odd_y = within(places.y[1], grid.last_y);
    const TexelQuads even(grid, even_x, even_y);
    const TexelQuads odd(grid, odd_x, odd_y);
    std::array<hn::Vec<Strip>, 4> texels_2x2;
    const auto red_and_blue = [&](const TexelQuads& of, TexelPlaces x, TexelPlaces y) HWY_ATTR {
        for (std::size_t i = 0; i < texels_2x2.size(); ++i) {
            texels_2x2[i] = hn::BitCast(Strip(), hn::And(of.texels_2x2[i], hn::Set(Texels(), 0x00ff00ffU)));
        }
        return hn::BitCast(Texels(), BilinearWeights(x, x, y, y).mixed(texels_2x2));
    };
    const auto of_even = red_and_blue(even, even_x, even_y);
    const auto of_odd = red_and_blue(odd, odd_x, odd_y);
    for (std::size_t i = 0; i < texels_2x2.size(); ++i) { // green
        texels_2x2[i] = hn::ShiftRight<8>(lower_halves(even.texels_2x2[i], odd.texels_2x2[i]));
    }
    return {lower_halves(of_even, of_odd), BilinearWeights(even_x, odd_x, even_y, odd_y).mixed(texels_2x2),
        upper_halves(of_even, of_odd)};
}

// -- Windows of eight pixels that wait for their colours: a register is filled with windows of any rows.

constexpr std::size_t texture_window_px = 8;
constexpr std::size_t windows_at_once = part_px / texture_window_px;
constexpr std::size_t windows_in_memory = 8; ///< TextureWindows::begin is read by so many, used or not
using TextureWindow = hn::CappedTag<std::uint16_t, texture_window_px>;

/// The next windows of a queue, as many as a register holds.
struct TextureWindows {
    const std::uint16_t* begin; ///< each one's first pixel, from the strip's first one

    HWY_INLINE hn::Vec<Strip> load(const std::uint16_t* from) const { return load(Strip(), from, begin); }

    /// In painting order: what lies beyond the end of a row is as it was.
    HWY_INLINE void store(hn::Vec<Strip> values, std::uint16_t* to) const { store(Strip(), values, to, begin); }

private:
    template <class Tag>
    static HWY_INLINE hn::Vec<Tag> load(Tag tag, const std::uint16_t* from, const std::uint16_t* windows) {
        if constexpr (hn::MaxLanes(tag) == texture_window_px) {
            return hn::LoadU(tag, from + *windows);
        } else {
            const hn::Half<Tag> half;
            return hn::Combine(tag, load(half, from, windows + windows_of(half)), load(half, from, windows));
        }
    }

    template <class Tag>
    static HWY_INLINE void store(Tag tag, hn::Vec<Tag> values, std::uint16_t* to, const std::uint16_t* windows) {
        if constexpr (hn::MaxLanes(tag) == texture_window_px) {
            hn::StoreU(values, tag, to + *windows);
        } else {
            const hn::Half<Tag> half;
            store(half, hn::LowerHalf(half, values), to, windows);
            store(half, hn::UpperHalf(half, values), to, windows + windows_of(half));
        }
    }

    template <class Tag>
    static constexpr std::size_t windows_of(Tag tag) {
        return hn::MaxLanes(tag) / texture_window_px;
    }
};

/// The windows of a strip of a triangle that have new samples, row after row.
class TextureQueue {
public:
    /// A row's new samples in parts of the strip; a window may reach beyond them. `row`: from the triangle's first.
    template <std::size_t parts>
    HWY_INLINE void add_row(std::size_t row, const std::array<hn::Vec<Strip>, parts>& fresh) {
        const std::size_t row_begin = row * tile_width;
        for (std::size_t i = 0; i < parts; ++i) {
            hn::StoreU(fresh[i], Strip(), fresh_.data() + row_begin + i * part_px);
        }
        put_none(row_begin + parts * part_px);
        std::uint32_t pixels = ~bits_equal_to(fresh, 0) & bits_of_parts<parts>;
        for (std::size_t i = 0; i < parts * part_px / texture_window_px; ++i) {
            const auto column = static_cast<std::uint32_t>(std::countr_zero(pixels)) % strip_px;
            windows_[count_] = static_cast<std::uint16_t>(row_begin + column);
            count_ += pixels != 0 ? 1 : 0;
            pixels &= ~(0xffU << column);
        }
    }

    /// Fills the last register with windows of a row in which nothing is new. `rows`: how many the triangle has.
    HWY_INLINE void finish(std::size_t rows) {
        const std::size_t row_begin = rows * tile_width;
        put_none(row_begin);
        for (std::size_t i = 0; i < windows_at_once; ++i) {
            windows_[count_ + i] = static_cast<std::uint16_t>(row_begin);
        }
    }

    std::size_t count() const { return count_; }

    /// The row of a window, from the triangle's first.
    std::size_t row(std::size_t window) const { return windows_[window] / tile_width; }

    /// The column of a window, from the strip's first.
    int column(std::size_t window) const { return windows_[window] % tile_width; }

    /// The windows from `first` on, as many as a register holds. Those from `end` on are replaced by windows without
    /// new samples, for which `room` has the memory.
    HWY_INLINE TextureWindows windows(
        std::size_t first, std::size_t end, std::array<std::uint16_t, windows_in_memory>& room) const {
        if (end == count_ || first + windows_at_once <= end) { return {windows_.data() + first}; }
        room.fill(windows_[count_]); // finish() has put one there
        std::copy(windows_.data() + first, windows_.data() + end, room.data());
        return {room.data()};
    }

    HWY_INLINE hn::Vec<Strip> fresh(const TextureWindows& windows) const { return windows.load(fresh_.data()); }

private:
    static constexpr std::size_t max_of_row = strip_px / texture_window_px;

    HWY_INLINE void put_none(std::size_t at) {
        hn::StoreU(hn::Zero(TextureWindow()), TextureWindow(), fresh_.data() + at);
    }

    /// New samples of pixels; rows lie as a tile's do.
    alignas(64) std::array<std::uint16_t, (tile_height + 1) * tile_width> fresh_;
    std::array<std::uint16_t, tile_height * max_of_row + windows_in_memory> windows_; ///< as TextureWindows::begin
    std::size_t count_ = 0;
};

// -- Planes of texture coordinates, light and haze over windows.

/// Four planes of a triangle over the windows of a strip, four lanes for a window: two of places in the texture, then
/// light and haze.
class WindowPlanes {
public:
    using Blocks = hn::Repartition<std::int32_t, Strip>;

    /// `first_px`: the strip's first pixel. Columns of light and haze are counted from so many columns left of it.
    HWY_INLINE
    WindowPlanes(const ColourGradients& gradients, const glm::ivec2& first_px, int columns_right) {
        alignas(16) static constexpr std::array<std::int32_t, 4> share_lanes{0, 0, -1, -1};
        // To the middle level, and what rounds levels to 1/128.
        alignas(16) static constexpr std::array<std::int32_t, 4> more{128 * 65536, 128 * 65536, 256, 256};
        const Blocks blocks;
        const auto set = [&](int value) HWY_ATTR { return hn::Set(blocks, value); };
        is_share_ = hn::LoadDup128(blocks, share_lanes.data());
        right_ = hn::And(set(columns_right), is_share_);
        const auto per_x = hn::LoadDup128(blocks, gradients.per_x.data());
        per_row_ = hn::LoadDup128(blocks, gradients.per_y.data());
        const auto base = hn::Add(hn::LoadDup128(blocks, gradients.base.data()), hn::LoadDup128(blocks, more.data()));
        const auto first_column = hn::Sub(set(first_px.x), right_);
        at_ = hn::Add(hn::Add(base, hn::Mul(per_x, first_column)), hn::Mul(per_row_, set(first_px.y)));
        const auto steps = hn::LoadDup128(StripSigned(), gradients.per_column.data());
        per_column_ =
            hn::IfVecThenElse(is_share_, hn::BitCast(blocks, hn::InterleaveLower(StripSigned(), steps, steps)), per_x);
    }

    /// At the windows' first pixels: 2^-16 texel, and in the lower halves of lanes 1/128 level from the level 128,
    /// wrapping.
    HWY_INLINE hn::Vec<Blocks> at(const TextureWindows& windows) const {
        constexpr std::uint8_t none = 0x80;
        alignas(64) static constexpr auto to_blocks = [] {
            std::array<std::uint8_t, 64> from{};
            for (std::size_t i = 0; i < from.size(); ++i) {
                from[i] = i % 4 < 2 ? static_cast<std::uint8_t>(i / 16 * 2 + i % 4) : none;
            }
            return from;
        }();
        const Blocks blocks;
        const hn::Repartition<std::uint8_t, Blocks> bytes;
        const auto eight = hn::BitCast(bytes, hn::LoadDup128(Strip(), windows.begin));
        const auto window = hn::BitCast(blocks, hn::TableLookupBytesOr0(eight, hn::Load(bytes, to_blocks.data())));
        static_assert(tile_width == 64);
        const auto row = hn::ShiftRight<6>(window);
        const auto column = hn::Add(hn::And(window, hn::Set(blocks, tile_width - 1)), right_);
        const auto of_row = hn::Add(at_, hn::Mul(row, per_row_));
        const auto of_column = hn::Mul(column, per_column_);
        return hn::Add(hn::IfVecThenElse(is_share_, hn::ShiftRight<9>(of_row), of_row), of_column);
    }

private:
    hn::Vec<Blocks> is_share_; ///< all bits of the lanes of light and haze
    hn::Vec<Blocks> right_;
    hn::Vec<Blocks> at_; ///< where columns are counted from, in the triangle's first row
    hn::Vec<Blocks> per_row_;
    hn::Vec<Blocks> per_column_;
};

/// A share of light or haze, 2^-16, from its level.
HWY_INLINE hn::Vec<Strip> share_of(hn::Vec<StripSigned> level) {
    return hn::ShiftLeft<1>(hn::Add(hn::BitCast(Strip(), level), hn::Set(Strip(), 128 * 128)));
}

/// Light or haze along windows, as StripGradient.
struct ShareSteps {
    hn::Vec<StripSigned> steps;
    hn::Vec<StripSigned> min;
    hn::Vec<StripSigned> max;

    HWY_INLINE ShareSteps(const ColourGradients& gradients, std::size_t k)
        : min(hn::Set(StripSigned(), gradients.min[k])), max(hn::Set(StripSigned(), gradients.max[k])) {
        const StripSigned sign;
        const auto px = hn::Set(sign, static_cast<std::int16_t>(texture_window_px - 1));
        steps = hn::Mul(hn::And(lane_indices_from(sign, 0), px), hn::Set(sign, gradients.per_column[k]));
    }

    HWY_INLINE hn::Vec<Strip> share(hn::Vec<StripSigned> first) const {
        return share_of(hn::Min(hn::Max(hn::Add(first, steps), min), max));
    }
};

/// The places of windows from those of their first pixels.
struct TextureCoordSteps {
    TexelPlaces of_even;
    TexelPlaces to_odd;

    HWY_INLINE explicit TextureCoordSteps(std::int32_t per_x) {
        const TexelsSigned whole;
        const auto pairs =
            hn::And(lane_indices_from(whole, 0), hn::Set(whole, static_cast<std::int32_t>(texture_window_px / 2 - 1)));
        to_odd = hn::Set(whole, per_x);
        of_even = hn::Mul(hn::ShiftLeft<1>(pairs), to_odd);
    }

    HWY_INLINE std::array<TexelPlaces, 2> from(TexelPlaces first) const {
        const auto even = hn::Add(first, of_even);
        return {even, hn::Add(even, to_odd)};
    }
};

// -- Colours: mip levels, several places in a pixel that is longer than wide, light and haze.

/// `weight`: of the other one, 2^-16.
HWY_INLINE hn::Vec<Strip> interpolated(hn::Vec<Strip> from, hn::Vec<Strip> to, hn::Vec<Strip> weight) {
    return hn::Add(hn::Sub(from, hn::MulHigh(from, weight)), hn::MulHigh(to, weight));
}

/// Places in the next coarser level.
HWY_INLINE TextureCoords coarser(const TextureCoords& places) {
    const auto of = [](TexelPlaces place) HWY_ATTR {
        const auto quarter = hn::Set(TexelsSigned(), 16384); // of a texel
        return hn::Sub(hn::ShiftRight<1>(place), quarter);
    };
    return {{of(places.x[0]), of(places.x[1])}, {of(places.y[0]), of(places.y[1])}};
}

/// What all pixels of the same planes have in common.
struct TextureSampler {
    TexelGrid fine;
    TexelGrid coarse;
    bool has_coarse; ///< else the fine one is all
    hn::Vec<Strip> coarse_share;
    // The places in the fine level whose mean is a pixel's colour, 2^-16 texel.
    int places;
    hn::Vec<Strip> share_of_place;          ///< 2^-16
    std::array<std::int32_t, 2> last_place; ///< from the pixel's middle
    std::array<std::int32_t, 2> place_step; ///< to the next one
    std::array<std::uint16_t, 3> haze;

    HWY_INLINE TextureSampler(const MipSelection& levels, const TileJob& job)
        : fine(job.ground->levels()[levels.fine]),
          coarse(job.ground->levels()[levels.fine + (levels.coarse_share > 0 ? 1U : 0U)]),
          has_coarse(levels.coarse_share > 0), coarse_share(hn::Set(Strip(), levels.coarse_share)),
          places(levels.probes), share_of_place(hn::Set(Strip(), static_cast<std::uint16_t>(65535 / levels.probes))) {
        const double scale = texel_scale(levels.fine);
        for (std::size_t k = 0; k < 2; ++k) {
            last_place[k] = static_cast<std::int32_t>(static_cast<double>(levels.reach[k]) * scale);
            place_step[k] = places > 1 ? 2 * last_place[k] / (places - 1) : 0;
        }
        for (std::size_t k = 0; k < haze.size(); ++k) {
            haze[k] = static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F);
        }
    }

    /// Whether a pixel takes one place of one level, as most do.
    bool is_single() const { return places == 1 && !has_coarse; }

    /// The texture's colours at places.
    HWY_INLINE Colours at(const TextureCoords& coords) const {
        Colours colours = filter_bilinear(fine, coords);
        if (has_coarse) {
            const Colours next = filter_bilinear(coarse, coarser(coords));
            for (std::size_t k = 0; k < 3; ++k) { colours[k] = interpolated(colours[k], next[k], coarse_share); }
        }
        return colours;
    }

    /// The mean over the places of a pixel; `is_single` as is_single() says.
    template <bool is_single>
    HWY_INLINE Colours mean(const TextureCoords& middle) const {
        if constexpr (is_single) { return filter_bilinear(fine, middle); }
        const auto from_middle = [&](std::int32_t dx, std::int32_t dy) HWY_ATTR {
            const auto x = hn::Set(TexelsSigned(), dx);
            const auto y = hn::Set(TexelsSigned(), dy);
            return at({{hn::Add(middle.x[0], x), hn::Add(middle.x[1], x)},
                {hn::Add(middle.y[0], y), hn::Add(middle.y[1], y)}});
        };
        Colours sum = from_middle(-last_place[0], -last_place[1]);
        if (places == 1) { return sum; }
        for (auto& colour : sum) { colour = hn::MulHigh(colour, share_of_place); }
        for (int k = 1; k < places; ++k) {
            const Colours one = from_middle(k * place_step[0] - last_place[0], k * place_step[1] - last_place[1]);
            for (std::size_t i = 0; i < 3; ++i) { sum[i] = hn::Add(sum[i], hn::MulHigh(one[i], share_of_place)); }
        }
        return sum;
    }

    /// Under light and behind haze, 1/16 level.
    HWY_INLINE Colours seen(const Colours& colours, hn::Vec<Strip> light_left, hn::Vec<Strip> haze_share) const {
        const auto seen_share = hn::MulHigh(light_left, hn::Not(haze_share));
        const auto of = [&](std::size_t k) HWY_ATTR {
            const auto own = hn::MulHigh(colours[k], seen_share);
            const auto of_haze = hn::MulHigh(hn::Set(Strip(), haze[k]), haze_share);
            return hn::ShiftRight<3>(hn::Add(hn::Add(own, of_haze), hn::Set(Strip(), 4)));
        };
        return {of(0), of(1), of(2)};
    }
};

// -- Triangles: strip by strip, coverage first.

/// A strip of a triangle while it is painted.
struct TexturedStrip {
    const TileJob& job;
    TileBox box; ///< of the triangle in the tile
    int left;    ///< first column of the strip
    TileBuffer& buffer;
    TextureQueue queue;

    /// The strip's first column and row in the picture.
    glm::ivec2 first_px() const { return job.first_px + glm::ivec2(left, box.first_row); }
};

/// Covers what is free of a triangle in a strip; what is new waits for its colours.
template <std::size_t parts>
HWY_INLINE void cover_texture_strip(const Triangle& triangle, const SampleLanes& lanes, TexturedStrip& strip) {
    using Values = PartValues<parts>;
    const auto wait = [&](int row, const Values& fresh)
                          HWY_ATTR { strip.queue.add_row(static_cast<std::size_t>(row - strip.box.first_row), fresh); };
    walk_strip<parts>(triangle, strip.job, lanes, strip.box, strip.left, strip.buffer, wait, []() HWY_ATTR {});
    strip.queue.finish(static_cast<std::size_t>(strip.box.last_row - strip.box.first_row + 1));
}

/// Colours the windows begin .. end - 1 of a strip. `columns_right`: as in WindowPlanes.
template <bool is_single>
HWY_INLINE void colour_windows(const ColourGradients& gradients, const TextureSampler& sampler, int columns_right,
    std::size_t begin, std::size_t end, TexturedStrip& strip) {
    const WindowPlanes planes(gradients, strip.first_px(), columns_right);
    const TextureCoordSteps x(gradients.per_x[0]);
    const TextureCoordSteps y(gradients.per_x[1]);
    const ShareSteps light(gradients, 2);
    const ShareSteps haze(gradients, 3);
    const auto strip_begin = static_cast<std::size_t>(strip.box.first_row * tile_width + strip.left);
    std::array<std::uint16_t, windows_in_memory> room;
    for (std::size_t i = begin; i < end; i += windows_at_once) {
        const TextureWindows windows = strip.queue.windows(i, end, room);
        const auto first = planes.at(windows);
        const auto halves = hn::BitCast(StripSigned(), first);
        const TextureCoords places{x.from(hn::Broadcast<0>(first)), y.from(hn::Broadcast<1>(first))};
        const Colours colours = sampler.seen(sampler.template mean<is_single>(places),
            light.share(hn::Broadcast<4>(halves)), haze.share(hn::Broadcast<6>(halves)));
        const auto counts = hn::PopulationCount(strip.queue.fresh(windows));
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = strip.buffer.sums[k].data() + strip_begin;
            windows.store(hn::Add(windows.load(sums), hn::Mul(colours[k], counts)), sums);
        }
    }
}

HWY_NOINLINE void colour_by_planes(const ColourGradients& gradients, const MipSelection& levels, int columns_right,
    std::size_t begin, std::size_t end, TexturedStrip& strip) {
    const TextureSampler sampler(levels, strip.job);
    if (sampler.is_single()) {
        colour_windows<true>(gradients, sampler, columns_right, begin, end, strip);
    } else {
        colour_windows<false>(gradients, sampler, columns_right, begin, end, strip);
    }
}

/// Colours a strip of a triangle in perspective: by planes over all rows, over four or over one, as the error allows,
/// else by planes of their own for each window.
HWY_INLINE void colour_in_perspective(const TriangleExtra& extra, TexturedStrip& strip) {
    const TextureQueue& queue = strip.queue;
    const glm::ivec2 first_px = strip.first_px();
    const auto fit = [&](int column, std::size_t row, int columns, int rows) {
        return fit_texture_planes(extra, {first_px.x + column, first_px.y + static_cast<int>(row), columns, rows},
            strip.job.ground->levels().size());
    };
    const int columns = std::min(strip.box.right - strip.left + 1, strip_px);
    int rows = strip.box.last_row - strip.box.first_row + 1;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < queue.count(); begin = end) {
        const std::size_t row = queue.row(begin);
        TexturePlanes planes = fit(0, row, columns, rows);
        for (; !planes.is_accurate && rows > 1; planes = fit(0, row, columns, rows)) { rows = rows > 4 ? 4 : 1; }
        end = begin + 1;
        if (planes.is_accurate) {
            while (end < queue.count() && queue.row(end) < row + static_cast<std::size_t>(rows)) { ++end; }
            colour_by_planes(planes.gradients, planes.mip_selection, 0, begin, end, strip);
        } else {
            const int column = queue.column(begin);
            planes = fit(column, row, static_cast<int>(texture_window_px), 1);
            colour_by_planes(planes.gradients, planes.mip_selection, -column, begin, end, strip);
        }
    }
}

/// Paints a triangle of Fill::Texture, or one of Fill::TextureInPerspective that no plane cuts.
HWY_NOINLINE void paint_texture(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const Triangle& triangle = *one.triangle;
    const TileBox box(triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) { return; }
    for (int left = box.left; left <= box.right; left += strip_px) {
        TexturedStrip strip{job, box, left, buffer, {}};
        with_parts_of_strip(
            box, left, [&](auto parts) HWY_ATTR { cover_texture_strip<parts>(triangle, lanes, strip); });
        if (triangle.fill == Fill::TextureInPerspective) {
            colour_in_perspective(*one.extra, strip);
        } else if (strip.queue.count() > 0) {
            colour_by_planes(triangle.gradients, triangle.texture, left - box.left, 0, strip.queue.count(), strip);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
