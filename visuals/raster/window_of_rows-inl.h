// Sixteen columns of a row and sixteen of the next one as one window of 32 pixels.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_WINDOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_WINDOW_INL
#undef OCTANT_RASTER_WINDOW_INL
#else
#define OCTANT_RASTER_WINDOW_INL
#endif

#include "visuals/raster/strip_level-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

constexpr int window_px = strip_px / 2;
constexpr bool has_pairs_of_rows = strip_parts == 1;

/// For each sample of two rows, in turn: sixteen bits.
using PairLanes = hn::Repartition<std::int16_t, Lanes>;
using PairBits = hn::RebindToUnsigned<PairLanes>;
using Row = hn::Half<Strip>;

/// Columns of a tile.
struct ColumnSpan {
    int first;
    int last; ///< before the first: none
};

/// Sixteen columns of a row and sixteen of the next one.
struct PairWindow {
    std::array<int, 2> first; ///< columns of the tile
    int row;                  ///< of the tile, the first one
    std::uint32_t columns;    ///< which of them count, those of the next row in the upper half

    HWY_INLINE PairWindow(const std::array<ColumnSpan, 2>& spans, int upper_row, int offset)
        : first{column_of(spans[0], offset), column_of(spans[1], offset)}
        , row(upper_row)
        , columns(bits_of(spans[0], offset) | bits_of(spans[1], offset) << 16U) {}

    std::size_t pixel(std::size_t which) const {
        return static_cast<std::size_t>(
            (row + static_cast<int>(which)) * tile_width + first[which]);
    }

    /// Whether a pixel of it is not covered whole.
    bool has_free(const std::uint64_t* full) const {
        return (((std::uint64_t{columns & 0xffffU} << first[0]) & ~full[0]) |
                ((std::uint64_t{columns >> 16U} << first[1]) & ~full[1])) != 0;
    }

    HWY_INLINE hn::Vec<Strip> load(const std::uint16_t* from) const {
        return hn::Combine(
            Strip(), hn::LoadU(Row(), from + pixel(1)), hn::LoadU(Row(), from + pixel(0)));
    }

    /// The first row's before the next one's: what lies beyond the end of a row is as it was.
    HWY_INLINE void store(hn::Vec<Strip> values, std::uint16_t* to) const {
        hn::StoreU(hn::LowerHalf(Row(), values), Row(), to + pixel(0));
        hn::StoreU(hn::UpperHalf(Row(), values), Row(), to + pixel(1));
    }

private:
    /// Where the row has no more columns it is any one.
    static int column_of(const ColumnSpan& span, int offset) {
        return span.first + offset <= span.last ? span.first + offset : span.first;
    }

    static std::uint32_t bits_of(const ColumnSpan& span, int offset) {
        const int count = std::clamp(span.last - span.first - offset + 1, 0, window_px);
        return (1U << count) - 1U;
    }
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
