// The walk over a strip's rows that triangles of levels and textured ones share: takes what is free. Included once for
// each instruction set.
#if defined(OCTANT_RASTER_STRIP_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_STRIP_WALK_INL
#undef OCTANT_RASTER_STRIP_WALK_INL
#else
#define OCTANT_RASTER_STRIP_WALK_INL
#endif

#include "visuals/raster/strip_gradient-inl.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

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

/// Covers what is free of a triangle in parts of the strip that begins at a column of the tile. Calls paint(row,
/// samples of the parts, those of them that are fresh) where some may be, and next_row() after each row.
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
            paint(row, masks, fresh);
            full |= std::uint64_t{full_bits(after)} << left;
            buffer.full_rows |= std::uint32_t{(full & full_row) == full_row} << row;
        }
        coverage.next_row();
        next_row();
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
