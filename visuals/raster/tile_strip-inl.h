// Which samples of a strip of 32 pixels a triangle covers: whole strips at once, whatever the triangle's corners do
// within the row. Included once for each instruction set.
#if defined(OCTANT_RASTER_STRIP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_STRIP_INL
#undef OCTANT_RASTER_STRIP_INL
#else
#define OCTANT_RASTER_STRIP_INL
#endif

#include "visuals/raster/lane_indices-inl.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

/// Where an edge crosses the middle of a row, from a column on, 2^-32 pixel, as StripEdge::x. `top`: of the edge, 1/256
/// pixel. `first_px`: column and row of the picture.
HWY_INLINE std::uint64_t strip_edge_x(const Edge& edge, std::int32_t top, const glm::ivec2& first_px) {
    // Less than the least distance of a crossing from a column's middle where it is not on it.
    constexpr std::uint64_t on_it = std::uint64_t{1} << 10;
    const auto rows = static_cast<std::uint64_t>(std::int64_t{first_px.y - first_row_of(top)});
    return static_cast<std::uint64_t>(edge.x) + static_cast<std::uint64_t>(edge.slope) * rows -
           (static_cast<std::uint64_t>(std::int64_t{first_px.x}) << 32) - on_it;
}

/// An edge in a strip of a tile, row by row.
struct StripEdge {
    std::uint64_t x; ///< at the middle of the row, from the strip's first column, 2^-32 pixel
    std::uint64_t slope;
    LaneValues offsets; ///< of each lane's crossing from the row's, 2^-16 pixel, and what rounds up

    HWY_INLINE StripEdge(const Edge& edge, std::int32_t top, const glm::ivec2& first_px, const LaneValues& down,
        const LaneValues& round_up)
        : x(strip_edge_x(edge, top, first_px)), slope(static_cast<std::uint64_t>(edge.slope)) {
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
        const auto most = hn::Set(bits, std::uint32_t{31});
        return hn::IfThenZeroElse(hn::Gt(from, most), hn::Shl(all, hn::Min(from, most)));
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

    HWY_INLINE void next_row() {
        whole_.x += whole_.slope;
        upper_.x += upper_.slope;
        lower_.x += lower_.slope;
        for (std::size_t i = 0; i < lane_parts; ++i) { y_[i] = hn::Add(y_[i], hn::Set(Lanes(), 256)); }
    }

private:
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

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
