// Strips of a tile: 32 pixels of one row at once, or 16 where these fill a register. In this order: numbers of lanes;
// the coverage masks of a strip from the edges of a triangle; colours and other planes over it; the loop over the
// strips of a triangle. Included once for each instruction set.
#if defined(OCTANT_RASTER_STRIP_COVERAGE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_STRIP_COVERAGE_INL
#undef OCTANT_RASTER_STRIP_COVERAGE_INL
#else
#define OCTANT_RASTER_STRIP_COVERAGE_INL
#endif

#include "visuals/raster/tile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <hwy/highway.h>
#include <type_traits>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// -- Lane numbers from a table. Highway's Iota becomes a loop where the compiler must not vectorize.

/// From `first` on, which lies within a tile.
template <class Tag>
HWY_INLINE hn::Vec<Tag> lane_indices_from(Tag tag, std::size_t first) {
    using Number = hn::TFromD<Tag>;
    alignas(64) static constexpr auto numbers = [] {
        std::array<Number, 2 * tile_width> values{};
        for (std::size_t i = 0; i < values.size(); ++i) { values[i] = static_cast<Number>(i); }
        return values;
    }();
    assert(first <= tile_width);
    return hn::LoadU(tag, numbers.data() + first);
}

// -- Coverage masks of a strip of 32 pixels. The steps are the same for every shape of the triangle within the row.

constexpr int strip_px = 32;

using Lanes = hn::CappedTag<std::int32_t, SamplePattern::lanes>;
using LaneBits = hn::RebindToUnsigned<Lanes>; ///< a bit for each pixel of a strip
using Strip = hn::CappedTag<std::uint16_t, strip_px>;

constexpr std::size_t lane_parts = SamplePattern::lanes / hn::MaxLanes(Lanes());
constexpr std::size_t strip_parts = strip_px / hn::MaxLanes(Strip());

/// A value for each sample of a pixel.
using LaneValues = std::array<hn::Vec<Lanes>, lane_parts>;
/// For each sample of a pixel the pixels of a strip.
using LaneMasks = std::array<hn::Vec<LaneBits>, lane_parts>;
/// For each pixel of a strip its samples, or anything else that takes 16 bits.
using StripValues = std::array<hn::Vec<Strip>, strip_parts>;

HWY_INLINE LaneValues load_lanes(const std::int32_t* table) {
    LaneValues values;
    for (std::size_t i = 0; i < lane_parts; ++i) { values[i] = hn::Load(Lanes(), table + i * hn::MaxLanes(Lanes())); }
    return values;
}

/// An edge in a strip of a tile, row by row.
struct StripEdge {
    std::uint64_t x; ///< at the middle of the row, from the strip's first column, 2^-32 pixel
    std::uint64_t slope;
    LaneValues offsets; ///< of each lane's crossing from the row's, 2^-16 pixel, and what rounds up

    HWY_INLINE StripEdge(const Edge& edge, std::int32_t top, const glm::ivec2& first_px, const LaneValues& down,
        const LaneValues& round_up)
        : x(edge_x(edge, top, first_px)), slope(static_cast<std::uint64_t>(edge.slope)) {
        const auto slope_32nd = hn::Set(Lanes(), static_cast<std::int32_t>(edge.slope >> 21));
        for (std::size_t i = 0; i < lane_parts; ++i) {
            offsets[i] = hn::Add(hn::Mul(down[i], slope_32nd), round_up[i]);
        }
    }

    HWY_INLINE std::int32_t middle() const { return static_cast<std::int32_t>(x >> 16); }

    /// The first column whose sample is not left of the edge.
    HWY_INLINE hn::Vec<Lanes> column(std::size_t part) const {
        return hn::ShiftRight<16>(hn::Add(hn::Set(Lanes(), middle()), offsets[part]));
    }
};

/// The pixels of a strip from a column on.
HWY_INLINE hn::Vec<LaneBits> pixels_from(hn::Vec<Lanes> column) {
    const LaneBits bits;
    const auto from = hn::BitCast(bits, hn::Max(column, hn::Zero(Lanes())));
    const auto all = hn::Set(bits, ~std::uint32_t{0});
    if constexpr (HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86) {
        return hn::Shl(all, from); // nothing is left where it is 32 or more
    } else {
        const auto max = hn::Set(bits, std::uint32_t{31});
        return hn::IfThenZeroElse(hn::Gt(from, max), hn::Shl(all, hn::Min(from, max)));
    }
}

/// Turns each block of 8 x 8 bits, a byte a row, over its diagonal.
template <class Words>
HWY_INLINE hn::Vec<Words> turned(hn::Vec<Words> rows) {
    const Words words;
#if HWY_TARGET == HWY_AVX3_DL
    // The matrix of an affine map applied to unit vectors; its rows count from the last.
    const auto units = hn::Set(words, std::uint64_t{0x8040201008040201});
    __m512i result;
    asm("vgf2p8affineqb $0, %2, %1, %0" : "=v"(result) : "v"(units.raw), "v"(rows.raw));
    return hn::Vec<Words>{result};
#else
    const auto swap = [&](auto bits, hn::Vec<Words> in, std::uint64_t which) HWY_ATTR {
        constexpr int by = decltype(bits)::value;
        const auto changed = hn::And(hn::Xor(in, hn::ShiftRight<by>(in)), hn::Set(words, which));
        return hn::Xor(hn::Xor(in, changed), hn::ShiftLeft<by>(changed));
    };
    const auto once = swap(std::integral_constant<int, 7>(), rows, 0x00aa00aa00aa00aa);
    const auto twice = swap(std::integral_constant<int, 14>(), once, 0x0000cccc0000cccc);
    return swap(std::integral_constant<int, 28>(), twice, 0x00000000f0f0f0f0);
#endif
}

/// Two rows of eight bytes each as eight pairs, in each block of sixteen bytes.
template <class Words>
HWY_INLINE hn::Vec<Strip> paired(hn::Vec<Words> rows) {
    const hn::Repartition<std::uint8_t, Words> bytes;
    alignas(16) static constexpr std::array<std::uint8_t, 16> order{
        0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15};
    return hn::BitCast(Strip(), hn::TableLookupBytes(hn::BitCast(bytes, rows), hn::LoadDup128(bytes, order.data())));
}

#if HWY_TARGET == HWY_AVX3_DL

/// Byte k of lane 8 h + 7 - j becomes byte j of word 2 k + h.
inline constexpr auto words_of_lanes = [] {
    std::array<std::uint8_t, 64> from{};
    for (unsigned at = 0; at < 64; ++at) {
        const unsigned word = at / 8;
        from[at] = static_cast<std::uint8_t>(4 * (8 * (word % 2) + 7 - at % 8) + word / 2);
    }
    return from;
}();

HWY_INLINE StripValues samples_of_pixels(const LaneMasks& lanes) {
    const hn::Repartition<std::uint64_t, LaneBits> words;
    const __m512i words_from = _mm512_loadu_si512(words_of_lanes.data());
    const hn::Vec<decltype(words)> rows{_mm512_permutexvar_epi8(words_from, lanes[0].raw)};
    return {paired<decltype(words)>(turned<decltype(words)>(rows))};
}

#else

/// From a bit for each pixel in sixteen lanes to a bit for each lane in 32 pixels.
template <std::size_t parts>
HWY_INLINE std::array<hn::Vec<Strip>, parts> samples_of_pixels(const std::array<hn::Vec<LaneBits>, parts>& lanes) {
    const hn::Repartition<std::uint8_t, LaneBits> bytes;
    const hn::Repartition<std::uint64_t, LaneBits> words;
    using Words = decltype(words);
    alignas(16) static constexpr std::array<std::uint8_t, 16> by_eight_pixels{
        0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15};
    std::array<hn::Vec<LaneBits>, parts> fours; // the bytes of four lanes that hold the same pixels, next to each other
    for (std::size_t i = 0; i < parts; ++i) {
        fours[i] = hn::BitCast(LaneBits(),
            hn::TableLookupBytes(hn::BitCast(bytes, lanes[i]), hn::LoadDup128(bytes, by_eight_pixels.data())));
    }
    const auto as_words = [&](hn::Vec<LaneBits> from) HWY_ATTR { return hn::BitCast(words, from); };
    const auto finished = [&](hn::Vec<Words> rows) HWY_ATTR { return paired<Words>(turned<Words>(rows)); };
    if constexpr (parts == 1) {
        alignas(64) static constexpr std::array<std::int32_t, 16> across{
            0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15};
        const LaneBits bits;
        return {finished(as_words(hn::TableLookupLanes(fours[0], hn::SetTableIndices(bits, across.data()))))};
    } else if constexpr (parts == 2) {
        alignas(32) static constexpr std::array<std::int32_t, 8> across{0, 4, 1, 5, 2, 6, 3, 7};
        const LaneBits bits;
        const auto indices = hn::SetTableIndices(bits, across.data());
        const auto low = as_words(hn::TableLookupLanes(fours[0], indices));
        const auto high = as_words(hn::TableLookupLanes(fours[1], indices));
        const auto even = finished(hn::InterleaveLower(words, low, high));
        const auto odd = finished(hn::InterleaveUpper(words, low, high));
        return {hn::ConcatLowerLower(Strip(), odd, even), hn::ConcatUpperUpper(Strip(), odd, even)};
    } else {
        const LaneBits bits;
        const auto low_a = as_words(hn::InterleaveLower(bits, fours[0], fours[1]));
        const auto low_b = as_words(hn::InterleaveLower(bits, fours[2], fours[3]));
        const auto high_a = as_words(hn::InterleaveUpper(bits, fours[0], fours[1]));
        const auto high_b = as_words(hn::InterleaveUpper(bits, fours[2], fours[3]));
        return {finished(hn::InterleaveLower(words, low_a, low_b)), finished(hn::InterleaveUpper(words, low_a, low_b)),
            finished(hn::InterleaveLower(words, high_a, high_b)), finished(hn::InterleaveUpper(words, high_a, high_b))};
    }
}

#endif

#if HWY_TARGET == HWY_AVX2

/// From a bit for each pixel of a strip's first half in sixteen lanes to a bit for each lane in 16 pixels. No lane has
/// pixels beyond.
HWY_INLINE hn::Vec<Strip> samples_of_half(const LaneMasks& lanes) {
    const hn::Repartition<std::uint8_t, LaneBits> bytes;
    const hn::Repartition<std::uint64_t, LaneBits> words;
    alignas(16) static constexpr std::array<std::uint8_t, 16> by_eight_pixels{
        0, 2, 4, 6, 1, 3, 5, 7, 8, 10, 12, 14, 9, 11, 13, 15};
    alignas(32) static constexpr std::array<std::int32_t, 8> across{0, 4, 2, 6, 1, 5, 3, 7};
    // Lanes 0 to 3, 8 to 11, 4 to 7, 12 to 15.
    const hn::Vec<decltype(bytes)> packed{_mm256_packus_epi32(lanes[0].raw, lanes[1].raw)};
    const auto fours =
        hn::BitCast(LaneBits(), hn::TableLookupBytes(packed, hn::LoadDup128(bytes, by_eight_pixels.data())));
    const auto rows = hn::BitCast(words, hn::TableLookupLanes(fours, hn::SetTableIndices(LaneBits(), across.data())));
    return paired<decltype(words)>(turned<decltype(words)>(rows));
}

#endif

/// The samples of the strips of a triangle's rows, one row after the other.
class StripCoverage {
public:
    /// `first_px`: the strip's first column and row in the picture. Only columns whose bits are in `columns` count.
    HWY_INLINE StripCoverage(
        const Triangle& triangle, const glm::ivec2& first_px, std::uint32_t columns, const SampleLanes& lanes)
        : down_(load_lanes(lanes.down.data())), round_up_(load_lanes(lanes.round_up.data())),
          whole_(triangle.whole, triangle.top, first_px, down_, round_up_),
          upper_(triangle.upper, triangle.top, first_px, down_, round_up_),
          lower_(triangle.lower, triangle.middle, first_px, down_, round_up_), columns_(columns),
          bends_left_(triangle.middle_is_left ? ~std::uint32_t{0} : 0U),
          top_(hn::Set(Lanes(), triangle.top - first_px.y * 256)),
          middle_(hn::Set(Lanes(), triangle.middle - first_px.y * 256)),
          bottom_(hn::Set(Lanes(), triangle.bottom - first_px.y * 256)) {
        for (std::size_t i = 0; i < lane_parts; ++i) {
            y_[i] = hn::ShiftLeft<3>(down_[i]); // 1/256 pixel
        }
    }

    /// Of the row at hand, in as many parts as the columns that count lie in.
    template <std::size_t parts>
    HWY_INLINE std::array<hn::Vec<Strip>, parts> samples() const {
#if HWY_TARGET == HWY_AVX2
        if constexpr (parts == 1) { return {samples_of_half(lanes())}; }
#endif
        if constexpr (parts == strip_parts) { return samples_of_pixels(lanes()); }
    }

    /// The pixels of the row at hand that each sample covers.
    HWY_INLINE LaneMasks lanes() const {
        const LaneBits bits;
        const auto bends_left = hn::Set(bits, bends_left_);
        const auto columns = hn::Set(bits, columns_);
        LaneMasks masks;
        for (std::size_t i = 0; i < lane_parts; ++i) {
            const auto is_before = [&](hn::Vec<Lanes> y) HWY_ATTR { return hn::Lt(y_[i], y); };
            const auto bent = pixels_from(hn::IfThenElse(is_before(middle_), upper_.column(i), lower_.column(i)));
            const auto whole = pixels_from(whole_.column(i));
            // From the left edge on, but not from the right edge on.
            const auto between =
                hn::And(hn::Xor(bent, whole), hn::Xor(whole, hn::And(bends_left, hn::Xor(bent, whole))));
            const auto in_height = hn::RebindMask(bits, hn::AndNot(is_before(top_), is_before(bottom_)));
            masks[i] = hn::IfThenElseZero(in_height, hn::And(between, columns));
        }
        return masks;
    }

    /// The samples of a pixel, from lanes().
    template <int column>
    static HWY_INLINE std::uint32_t samples_of(const LaneMasks& masks) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < lane_parts; ++i) {
            // The pixel's bit becomes the sign.
            const auto lanes = hn::BitCast(Lanes(), hn::ShiftLeft<strip_px - 1 - column>(masks[i]));
            std::array<std::uint8_t, 8> some{};
            hn::StoreMaskBits(Lanes(), hn::MaskFromVec(hn::BroadcastSignBit(lanes)), some.data());
            bits |= static_cast<std::uint32_t>(some[0] | some[1] << 8) << (i * hn::MaxLanes(Lanes()));
        }
        return bits;
    }

    HWY_INLINE void next_row() {
        whole_.x += whole_.slope;
        upper_.x += upper_.slope;
        lower_.x += lower_.slope;
        for (std::size_t i = 0; i < lane_parts; ++i) { y_[i] = hn::Add(y_[i], hn::Set(Lanes(), 256)); }
    }

private:
    LaneValues down_;
    LaneValues round_up_;
    LaneValues y_; ///< of the samples, from the first row's middle, 1/256 pixel
    StripEdge whole_;
    StripEdge upper_;
    StripEdge lower_;
    std::uint32_t columns_;
    std::uint32_t bends_left_; ///< all bits or none
    hn::Vec<Lanes> top_;       ///< as y_
    hn::Vec<Lanes> middle_;
    hn::Vec<Lanes> bottom_;
};

// -- Colour gradients over a strip, and the box of a tile that a triangle's strips cover.

using StripSigned = hn::RebindToSigned<Strip>;
constexpr std::size_t part_px = hn::MaxLanes(Strip());

/// A bit for each pixel of so many parts of a strip.
template <std::size_t parts>
constexpr std::uint32_t bits_of_parts = ~0U >> (strip_px - parts * part_px);

/// The part of a tile in which a triangle may cover something.
struct TileBox {
    int left;
    int right;
    int first_row;
    int last_row;

    HWY_INLINE TileBox(const Triangle& triangle, const TileJob& job)
        : left(std::max(triangle.left - job.first_px.x, 0)),
          right(std::min(triangle.right - job.first_px.x, job.size_px.x - 1)),
          first_row(std::max(triangle.first_row - job.first_px.y, 0)),
          last_row(std::min(triangle.last_row - job.first_px.y, job.size_px.y - 1)) {}

    /// A bit for each column from `left_column` on that belongs to it.
    std::uint32_t columns_of_strip(int left_column) const {
        const int width = right - left_column + 1;
        return width >= strip_px ? ~0U : (1U << width) - 1U;
    }

    std::uint32_t rows() const {
        return static_cast<std::uint32_t>((std::uint64_t{2} << last_row) - (std::uint64_t{1} << first_row));
    }

    /// Leaves out the first and the last rows that have no free pixel. Returns false if none has.
    HWY_INLINE bool keep_free_rows(const TileBuffer& buffer) {
        const std::uint64_t columns = (~std::uint64_t{0} >> (tile_width - 1 - right + left)) << left;
        const auto is_full = [&](int row) { return (columns & ~buffer.full[static_cast<std::size_t>(row)]) == 0; };
        while (first_row <= last_row && is_full(first_row)) { ++first_row; }
        while (first_row <= last_row && is_full(last_row)) { --last_row; }
        return first_row <= last_row;
    }
};

/// ColourGradients::wrapped() with what rounds it to 1/128 level.
HWY_INLINE std::uint32_t first_level(const ColourGradients& gradients, std::size_t k, const glm::ivec2& at) {
    return gradients.wrapped(k, at) + 256U;
}

/// From 1/128 level, counted from the level 128, to 1/16 level from 0.
HWY_INLINE hn::Vec<Strip> from_level(hn::Vec<StripSigned> level) {
    return hn::ShiftRight<3>(hn::Add(hn::BitCast(Strip(), level), hn::Set(Strip(), 128 * 128 + 4)));
}

/// A level over a strip, row by row: 1/128 level from the level 128, wrapping.
struct StripGradient {
    std::uint32_t at; ///< where columns are counted from, 2^-16 level
    std::uint32_t per_row;
    hn::Vec<StripSigned> min;
    hn::Vec<StripSigned> max;
    std::array<hn::Vec<StripSigned>, strip_parts> steps;

    /// The strip begins some columns right of a pixel from which columns are counted.
    HWY_INLINE
    StripGradient(const ColourGradients& gradients, std::size_t k, const glm::ivec2& from_px, int columns_right)
        : at(first_level(gradients, k, from_px)), per_row(static_cast<std::uint32_t>(gradients.per_y[k])),
          min(hn::Set(StripSigned(), gradients.min[k])), max(hn::Set(StripSigned(), gradients.max[k])) {
        const StripSigned sign;
        const auto per_column = hn::Set(sign, gradients.per_column[k]);
        for (std::size_t i = 0; i < strip_parts; ++i) {
            const std::size_t first = static_cast<std::size_t>(columns_right) + i * part_px;
            steps[i] = hn::Mul(lane_indices_from(sign, first), per_column);
        }
    }

    /// 1/128 level from the level 128.
    HWY_INLINE hn::Vec<StripSigned> level(std::size_t part) const {
        const auto first = static_cast<std::int16_t>(static_cast<std::int32_t>(at) >> 9);
        const auto raw = hn::Add(hn::Set(StripSigned(), first), steps[part]);
        return hn::Min(hn::Max(raw, min), max);
    }

    /// In 1/16 level from 0.
    HWY_INLINE hn::Vec<Strip> colour(std::size_t part) const { return from_level(level(part)); }
};

/// Red, green and blue of a triangle over a strip.
HWY_INLINE std::array<StripGradient, 3> strip_gradients(
    const ColourGradients& gradients, const glm::ivec2& from_px, int columns_right) {
    const auto level = [&](std::size_t k) HWY_ATTR { return StripGradient(gradients, k, from_px, columns_right); };
    return {level(0), level(1), level(2)};
}

/// A bit for each pixel of so many parts of a strip that has a value.
template <std::size_t parts>
HWY_INLINE std::uint32_t bits_equal_to(const std::array<hn::Vec<Strip>, parts>& values, std::uint16_t value) {
    const auto is_equal = [&](std::size_t part) HWY_ATTR { return hn::Eq(values[part], hn::Set(Strip(), value)); };
#if HWY_TARGET == HWY_AVX2
    // Written to memory part by part and read as one, they would come late.
    const __m256i bytes = _mm256_packs_epi16(
        hn::VecFromMask(Strip(), is_equal(0)).raw, hn::VecFromMask(Strip(), is_equal(parts - 1)).raw);
    constexpr int in_order = 0xd8; // of four times eight
    const auto bits = static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permute4x64_epi64(bytes, in_order)));
    return bits & bits_of_parts<parts>;
#else
    alignas(8) std::array<std::uint8_t, 16> bytes;
    constexpr std::size_t bytes_a_part = part_px / 8;
    for (std::size_t i = 0; i < parts; ++i) {
        hn::StoreMaskBits(Strip(), is_equal(i), bytes.data() + i * bytes_a_part);
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes.data(), parts * bytes_a_part);
    return bits;
#endif
}

/// A bit for each pixel of so many parts of a strip whose value has all bits set.
template <std::size_t parts>
HWY_INLINE std::uint32_t full_bits(const std::array<hn::Vec<Strip>, parts>& values) {
    return bits_equal_to(values, 0xffff);
}

// -- The loop over the rows of a strip, shared by Gouraud-shaded and textured triangles: marks the free samples as
// covered.

/// Whether half a strip fills a register: what is no wider takes half the work.
constexpr bool has_half_strips = HWY_TARGET == HWY_AVX2;
static_assert(!has_half_strips || strip_parts == 2);

/// A value for each pixel in so many parts of a strip.
template <std::size_t parts>
using PartValues = std::array<hn::Vec<Strip>, parts>;

/// Calls paint(how many parts of a strip a triangle may lie in), a constant.
template <class Paint>
HWY_INLINE void with_parts_of_strip(const TileBox& box, int left, const Paint& paint) {
    if constexpr (has_half_strips) {
        if (box.right - left < strip_px / 2) {
            paint(std::integral_constant<std::size_t, 1>());
            return;
        }
    }
    paint(std::integral_constant<std::size_t, strip_parts>());
}

/// Covers what is free of a triangle in parts of the strip that begins at a column of the tile. Calls paint(row, fresh
/// samples of the parts) where some may be, and next_row() after each row.
template <std::size_t parts, class Paint, class NextRow>
HWY_INLINE void walk_strip(const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, const TileBox& box,
    int left, TileBuffer& buffer, const Paint& paint, const NextRow& next_row) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t wide_columns = std::uint64_t{columns} << left;
    const std::uint64_t full_row = job.full_row();
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    StripCoverage coverage(triangle, first_px, columns, lanes);
    for (int row = box.first_row; row <= box.last_row; ++row) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        if ((wide_columns & ~full) != 0) {
            std::uint16_t* const covered = buffer.covered.data() + row * tile_width + left;
            const auto masks = coverage.template samples<parts>();
            PartValues<parts> fresh;
            PartValues<parts> after;
            for (std::size_t i = 0; i < parts; ++i) {
                const auto before = hn::LoadU(Strip(), covered + i * part_px);
                fresh[i] = hn::AndNot(before, masks[i]);
                after[i] = hn::Or(before, masks[i]);
                hn::StoreU(after[i], Strip(), covered + i * part_px);
            }
            paint(row, fresh);
            full |= std::uint64_t{full_bits(after)} << left;
            buffer.full_rows |= std::uint32_t{(full & full_row) == full_row} << row;
        }
        coverage.next_row();
        next_row();
    }
}

// -- Masks of a whole tile: TileBuffer::masks.

constexpr int block_px = 16;

/// Calls visit(column and row of the tile, number of the pixel, mask) for each pixel of which cover() found samples.
template <class Visit>
HWY_INLINE void for_each_covered(const TileJob& job, const TileBuffer& buffer, const Visit& visit) {
    const Coverage& coverage = buffer.coverage;
    for (int row = coverage.first_row; row <= coverage.last_row; ++row) {
        const Coverage::Row places = coverage.rows[static_cast<std::size_t>(row)];
        const int end = std::min(places.first + places.blocks * block_px, job.size_px.x);
        const std::uint16_t* const masks = buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row;
        for (int column = places.first; column < end; ++column) {
            if (masks[column] != 0) {
                visit(glm::ivec2(column, row), static_cast<std::size_t>(row * tile_width + column), masks[column]);
            }
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
