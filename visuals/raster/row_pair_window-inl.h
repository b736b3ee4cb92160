// Sixteen columns of a row and sixteen of the next one as one window of 32 pixels. Included once for each instruction
// set.
#if defined(OCTANT_RASTER_WINDOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_WINDOW_INL
#undef OCTANT_RASTER_WINDOW_INL
#else
#define OCTANT_RASTER_WINDOW_INL
#endif

#include "visuals/raster/strip_gradient-inl.h"

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
using RowLanes = hn::Half<Strip>;

/// Sixteen columns of a row and of the next one.
struct PairWindow {
    int left;              ///< column of the tile
    int row;               ///< of the tile, the first one
    std::uint32_t columns; ///< which of them count, those of the next row in the upper half

    /// From the first column of a box that has no more of them.
    HWY_INLINE PairWindow(const TileBox& box, int upper_row) : left(box.left), row(upper_row) {
        const std::uint32_t of_row = box.columns_of_strip(left);
        columns = upper_row < box.last_row ? of_row * 0x10001U : of_row;
    }

    std::size_t pixel(int which) const { return static_cast<std::size_t>((row + which) * tile_width + left); }

    /// Whether a pixel of it is not covered whole.
    bool has_free(const std::uint64_t* full) const {
        return (((columns & 0xffffU) & ~(full[0] >> left)) | ((columns >> 16U) & ~(full[1] >> left))) != 0;
    }

    HWY_INLINE hn::Vec<Strip> load(const std::uint16_t* from) const {
        return hn::Combine(Strip(), hn::LoadU(RowLanes(), from + pixel(1)), hn::LoadU(RowLanes(), from + pixel(0)));
    }

    /// The first row's before the next one's: what lies beyond the end of a row is as it was.
    HWY_INLINE void store(hn::Vec<Strip> values, std::uint16_t* to) const {
        hn::StoreU(hn::LowerHalf(RowLanes(), values), RowLanes(), to + pixel(0));
        hn::StoreU(hn::UpperHalf(RowLanes(), values), RowLanes(), to + pixel(1));
    }
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
