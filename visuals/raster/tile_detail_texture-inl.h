// The fine pattern of near ground, once for each pixel when a tile's triangles are painted: how near the ground is
// there says where the pixel looks in the pattern, and what its neighbours see says at which level. The pattern is
// taken at every second pixel, and even in between. Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_INL
#undef OCTANT_RASTER_GRAIN_INL
#else
#define OCTANT_RASTER_GRAIN_INL
#endif

#include "visuals/raster/detail_contrast-inl.h"
#include "visuals/raster/detail_row-inl.h"
#include "visuals/raster/strip_gradient-inl.h"
#include "visuals/scene/detail_pattern.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// Changes colours of a row of pixels of a tile by the pattern. `ground`: of its pairs of pixels.
HWY_INLINE void change_row(const DetailRow& detail_texture, const std::uint32_t* ground, const std::uint32_t* table,
    int row, TileBuffer& buffer) {
    const PixelPairBits bits;
    const PixelPairHalves halves;
    const hn::RebindToUnsigned<PixelPairHalves> values;
    const auto white = hn::Set(values, std::uint16_t{255 * 256});
    const auto middle = hn::Set(values, std::uint16_t{0x8000});
    const auto all = hn::Set(values, std::uint16_t{16});
    const bool is_full = (buffer.full_rows >> row & 1U) != 0;
    for (std::size_t two = 0; two < pairs_per_row; two += pairs_at_once) {
        const auto seen = hn::Load(bits, &detail_texture.seen[two]);
        if (hn::AllTrue(bits, hn::Eq(seen, hn::Zero(bits)))) { continue; }
        const std::size_t at = static_cast<std::size_t>(row) * tile_width + 2 * two;
        const PairContrast contrast(
            seen, hn::LoadU(bits, &detail_texture.seen[two + 1]), hn::LoadU(bits, ground + two), table);
        const auto left = hn::And(seen, pair_bits(0x7fff));
        auto of_ground = hn::BitCast(values, hn::Or(left, hn::ShiftLeft<16>(left)));
        // Where other things than ground cover some samples, only the ground's share changes.
        const auto other_than_ground = hn::LoadU(values, buffer.sums[3].data() + at);
        if (!is_full || !hn::AllTrue(values, hn::Eq(other_than_ground, hn::Zero(values)))) {
            const auto covered = hn::LoadU(values, buffer.covered.data() + at);
            const auto count = hn::Sub(hn::PopulationCount(covered), other_than_ground);
            const auto of_some = hn::MulHigh(of_ground, hn::ShiftLeft<12>(count));
            of_ground = hn::IfThenElse(hn::Eq(count, all), of_ground, of_some);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data() + at;
            const auto change = hn::MulFixedPoint15(contrast.part[k], hn::BitCast(halves, of_ground));
            const auto half = hn::MulHigh(hn::LoadU(values, sums), hn::Xor(hn::BitCast(values, change), middle));
            hn::StoreU(hn::Min(hn::SaturatedAdd(half, half), white), values, sums);
        }
    }
}

/// Changes rows of pixels by what pairs in rows one after the other see.
class DetailApplier {
public:
    HWY_INLINE DetailApplier(const TileJob& job, const TileInverseDepths& inverse_depth, TileBuffer& buffer)
        : job_(job), inverse_depths_(inverse_depth), buffer_(buffer) {}

    /// The pixels between a row of pairs and the one above it, and its own.
    HWY_NOINLINE void change(int row, const DetailRow& above, const DetailRow& own) {
        const bool is_seen = inverse_depths_.has_ground(row);
        if (is_seen && row > 0 && inverse_depths_.has_ground(row - 1)) {
            DetailRow between;
            between.put_between(above, own);
            change_pixels(2 * row - 1, between);
        }
        if (is_seen && 2 * row < job_.size_px.y) { change_pixels(2 * row, own); }
    }

private:
    HWY_INLINE void change_pixels(int row, const DetailRow& detail_texture) {
        change_row(detail_texture, buffer_.ground_of_row(row & ~1), job_.detail_texture->contrast, row, buffer_);
    }

    const TileJob& job_;
    const TileInverseDepths& inverse_depths_;
    TileBuffer& buffer_;
};

/// Changes what a tile's pixels have summed up by the fine pattern, where its triangles are painted.
HWY_NOINLINE void add_detail_texture(const TileJob& job, TileBuffer& buffer) {
    const TileInverseDepths inverse_depth(job, buffer);
    if (!inverse_depth.has_ground()) { return; }
    const TileDetailSampler look(job, inverse_depth);
    std::array<DetailPositionRow, 2> places;
    std::array<DetailRow, tile_height / 2 + 1> seen;
    DetailPositionRow* above = &places[0];
    DetailPositionRow* below = &places[1];
    const int last = job.size_px.y / 2;
    const auto look_up = [&](int row) HWY_ATTR {
        if (inverse_depth.has_ground(row)) {
            look.look(row, *above, row % 2 == 0 ? *above : *below, seen[static_cast<std::size_t>(row)]);
        }
    };
    // Places are written a while before they are read.
    for (int row = 0; row < last + 2; row += 2) {
        if (row <= last && inverse_depth.has_ground(row)) {
            look.find(row, *below);
        } else {
            below->clear();
        }
        if (row > 0) {
            look_up(row - 2);
            look_up(row - 1);
        }
        std::swap(above, below);
    }
    if (last % 2 == 0) { look_up(last); }
    DetailApplier walk(job, inverse_depth, buffer);
    for (int row = 0; row <= last; ++row) {
        const auto at = static_cast<std::size_t>(row);
        walk.change(row, seen[row == 0 ? 0 : at - 1], seen[at]);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
