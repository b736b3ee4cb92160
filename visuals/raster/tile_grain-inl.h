// The fine pattern of near ground, once for each pixel when a tile's triangles are painted: how
// near the ground is there says where the pixel looks in the pattern, and what its neighbours see
// says at which level. The pattern is taken at every second pixel, and even in between. Included
// once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_INL
#undef OCTANT_RASTER_GRAIN_INL
#else
#define OCTANT_RASTER_GRAIN_INL
#endif

#include "visuals/raster/grain_contrast-inl.h"
#include "visuals/raster/grain_row-inl.h"
#include "visuals/raster/strip_level-inl.h"
#include "visuals/scene/grain_pattern.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// Changes colours of a row of pixels from `first` on by the pattern.
HWY_INLINE void change_row(
    const GrainRow& grain, const std::uint32_t* table, std::size_t first, TileBuffer& buffer) {
    const TwosHalves halves;
    const hn::RebindToUnsigned<TwosHalves> values;
    const auto white = hn::Set(values, std::uint16_t{255 * 256});
    for (std::size_t two = 0; two < twos_a_row; two += twos_at_once) {
        const std::size_t at = first + 2 * two;
        const GroundOfPixels ground(hn::LoadU(values, buffer.sums[3].data() + at));
        const ContrastOfTwos contrast(grain, two, hn::BitCast(TwosBits(), ground.kind), table);
        const auto left = hn::And(hn::LoadU(TwosBits(), &grain.seen[two]), twos_of(0x7fff));
        const auto left_of_both = hn::BitCast(values, hn::Or(left, hn::ShiftLeft<16>(left)));
        // Where other things than ground cover some samples, only the ground's share changes.
        const auto is_whole = hn::Eq(ground.samples, hn::Set(values, std::uint16_t{16}));
        const auto of_some = hn::MulHigh(left_of_both, hn::ShiftLeft<12>(ground.samples));
        const auto of_ground = hn::BitCast(halves, hn::IfThenElse(is_whole, left_of_both, of_some));
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data() + at;
            const auto own = hn::LoadU(values, sums);
            const auto half_own = hn::BitCast(halves, hn::ShiftRight<1>(own));
            const auto seen = hn::ShiftLeft<1>(hn::MulHigh(contrast.part[k], of_ground));
            const auto quarter = hn::MulHigh(half_own, seen);
            const auto times_four = [&](hn::Vec<TwosHalves> value) HWY_ATTR {
                return hn::ShiftLeft<2>(hn::BitCast(values, hn::Max(value, hn::Zero(halves))));
            };
            const auto brighter = hn::Min(hn::SaturatedAdd(own, times_four(quarter)), white);
            hn::StoreU(hn::SaturatedSub(brighter, times_four(hn::Neg(quarter))), values, sums);
        }
    }
}

/// Changes what a tile's pixels have summed up by the fine pattern, where its triangles are
/// painted.
HWY_NOINLINE void add_grain(const TileJob& job, TileBuffer& buffer) {
    const TileNearness nearness(job, buffer);
    if (!nearness.has_ground()) {
        return;
    }
    const RowLook look(job, nearness);
    std::array<GrainRow, 3> rows;
    GrainRow* above = &rows[0];
    GrainRow* below = &rows[1];
    const auto change = [&](int row, const GrainRow& grain) HWY_ATTR {
        change_row(grain, job.grain->contrast, static_cast<std::size_t>(row) * tile_width, buffer);
    };
    for (int row = 0; row <= job.size_px.y / 2; ++row) {
        const bool is_seen = nearness.has_ground(row);
        if (is_seen) {
            look.at(row, *below);
        }
        if (is_seen && row > 0 && nearness.has_ground(row - 1)) {
            RowLook::between(*above, *below, rows[2]);
            change(2 * row - 1, rows[2]);
        }
        if (is_seen && 2 * row < job.size_px.y) {
            change(2 * row, *below);
        }
        std::swap(above, below);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
