// What the pixels of a tile see of the fine pattern of ground. Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_ROW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_ROW_INL
#undef OCTANT_RASTER_GRAIN_ROW_INL
#else
#define OCTANT_RASTER_GRAIN_ROW_INL
#endif

#include "visuals/raster/detail_positions-inl.h"
#include "visuals/scene/detail_pattern.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// The pattern at places of a level of each, mixed from four texels: 2^-15, from -1 to 1. Places are as
/// DetailPositions::fine_x.
HWY_INLINE hn::Vec<PixelPairInts> sample_detail_level(
    const DetailImage& image, hn::Vec<PixelPairBits> x, hn::Vec<PixelPairBits> y, hn::Vec<PixelPairBits> level) {
    const PixelPairBits bits;
    const hn::Repartition<std::uint16_t, PixelPairBits> halves;
    const auto last = hn::Shr(pair_bits(DetailImage::side - 1), level);
    const auto column = hn::And(hn::ShiftRight<8>(x), last);
    const auto in_level = hn::And(hn::ShiftRight<8>(y), last);
    const auto first_row = hn::Sub(pair_bits(2 * DetailImage::side), hn::Shr(pair_bits(2 * DetailImage::side), level));
    const auto row = hn::Add(first_row, in_level);
    static_assert(DetailImage::stride == (1 << 9) + 1);
    const auto texel = hn::Add(hn::Add(hn::ShiftLeft<9>(row), row), column);
    const auto four = hn::GatherOffset(bits, reinterpret_cast<const std::uint32_t*>(image.texels()),
        hn::BitCast(PixelPairInts(), hn::Add(texel, texel)));
    const auto byte_of_each = pair_bits(0x00ff00ff);
    const auto own = hn::BitCast(halves, hn::And(four, byte_of_each));
    const auto above = hn::BitCast(halves, hn::And(hn::ShiftRight<8>(four), byte_of_each));
    const auto up = hn::And(y, pair_bits(0xff));
    const auto ups = hn::BitCast(halves, hn::Or(up, hn::ShiftLeft<16>(up)));
    const auto both = hn::BitCast(bits, hn::Add(hn::ShiftLeft<8>(own), hn::Mul(hn::Sub(above, own), ups)));
    const auto left = hn::BitCast(PixelPairInts(), hn::And(both, pair_bits(0xffff)));
    const auto right = hn::BitCast(PixelPairInts(), hn::ShiftRight<16>(both));
    const auto rightwards = hn::BitCast(PixelPairInts(), hn::And(x, pair_bits(0xff)));
    const auto mean = hn::Add(left, hn::ShiftRight<8>(hn::Mul(hn::Sub(right, left), rightwards)));
    return hn::Sub(mean, hn::Set(PixelPairInts(), 128 * 256));
}

/// Places of every second pair of a row, and of the one right of the tile.
struct DetailPositionRow {
    using Each = std::array<std::uint32_t, pairs_per_phase + 16>;

    alignas(64) std::array<Each, 6> value; ///< as DetailPositions

    HWY_INLINE DetailPositions places(std::size_t at) const {
        const auto whole = [&](std::size_t which) HWY_ATTR {
            return hn::BitCast(PixelPairInts(), hn::LoadU(PixelPairBits(), &value[which][at]));
        };
        return {whole(0), whole(1), whole(2), whole(3), hn::LoadU(PixelPairBits(), &value[4][at]),
            hn::LoadU(PixelPairBits(), &value[5][at])};
    }

    HWY_INLINE void put(const DetailPositions& places, std::size_t at) {
        const auto put_one = [&](std::size_t which, auto values) HWY_ATTR {
            hn::StoreU(hn::BitCast(PixelPairBits(), values), PixelPairBits(), &value[which][at]);
        };
        put_one(0, places.fine_x);
        put_one(1, places.fine_y);
        put_one(2, places.coarse_x);
        put_one(3, places.coarse_y);
        put_one(4, places.level);
        put_one(5, places.left);
    }

    /// No ground.
    void clear() {
        for (Each& each : value) { each.fill(0); }
    }
};

/// What pairs of pixels see: in the upper half the pattern at the first one's place, 2^-15, in the lower half what the
/// haze leaves of it, likewise; 0: no ground. Of both scales together: the squares of their shares are about one, so
/// that the contrast stays while one gives way to the other while its levels are gone through. Most pixels take one
/// level: the next one comes in over a third of the way only.
HWY_INLINE hn::Vec<PixelPairBits> sample_detail(const DetailImage& image, const DetailPositions& places) {
    const PixelPairBits bits;
    const PixelPairInts whole;
    const auto share_of = [&](hn::Vec<PixelPairInts> value, hn::Vec<PixelPairInts> share)
                              HWY_ATTR { return hn::ShiftRight<8>(hn::Mul(value, share)); };
    const auto half_texel = pair_bits(128);
    const auto all = hn::Set(whole, 256);
    const auto part = hn::BitCast(whole, hn::And(hn::ShiftRight<16>(places.level), pair_bits(0xff)));
    const auto from_band = hn::Sub(part, hn::Set(whole, 85));
    const auto thrice = hn::Add(hn::Add(from_band, from_band), from_band);
    const auto share = hn::Min(hn::Max(thrice, hn::Zero(whole)), all);
    // What has the next level whole has it alone.
    const auto is_next = hn::ShiftRight<8>(hn::BitCast(bits, share));
    static_assert(scene::DetailPattern::levels_per_scale == 4);
    const auto level = hn::Add(hn::And(hn::ShiftRight<24>(places.level), pair_bits(3)), is_next);
    const auto at_level = [&](hn::Vec<PixelPairBits> of) HWY_ATTR {
        const auto place = [&](hn::Vec<PixelPairInts> fine_coord)
                               HWY_ATTR { return hn::Sub(hn::Shr(hn::BitCast(bits, fine_coord), of), half_texel); };
        return sample_detail_level(image, place(places.fine_x), place(places.fine_y), of);
    };
    const auto coarse = sample_detail_level(image, hn::Sub(hn::BitCast(bits, places.coarse_x), half_texel),
        hn::Sub(hn::BitCast(bits, places.coarse_y), half_texel), hn::Zero(bits));
    auto fine = at_level(level);
    const auto next_level = hn::And(hn::BitCast(bits, share), pair_bits(0xff));
    if (!hn::AllTrue(bits, hn::Eq(next_level, hn::Zero(bits)))) {
        const auto next = at_level(hn::Add(level, pair_bits(1)));
        fine = hn::Add(fine, share_of(hn::Sub(next, fine), hn::BitCast(whole, next_level)));
    }
    const auto through = hn::BitCast(whole, hn::And(hn::ShiftRight<18>(places.level), pair_bits(0xff)));
    const auto before = hn::Sub(all, through);
    const auto both = hn::Add(share_of(fine, hn::Sub(all, share_of(through, through))),
        share_of(coarse, hn::Sub(all, share_of(before, before))));
    const auto limited = hn::Min(hn::Max(both, hn::Set(whole, -32768)), hn::Set(whole, 32767));
    const auto seen = hn::Or(hn::ShiftLeft<16>(hn::BitCast(bits, limited)), places.left);
    return hn::IfThenZeroElse(hn::Eq(places.left, hn::Zero(bits)), seen);
}

/// What a row's pairs of pixels see, and what the one beside it does.
struct DetailRow {
    alignas(64) std::array<std::uint32_t, pairs_per_row + 16> seen;

    /// Between two rows.
    HWY_INLINE void put_between(const DetailRow& above, const DetailRow& below) {
        for (std::size_t two = 0; two < pairs_per_row; two += pairs_at_once) {
            const auto of = [&](const DetailRow& row) HWY_ATTR { return hn::Load(PixelPairBits(), &row.seen[two]); };
            hn::Store(seen_between(of(above), of(below)), PixelPairBits(), &seen[two]);
        }
        seen[pairs_per_row] = below.seen[pairs_per_row];
    }

private:
    /// In the middle between pairs that see ground; none between others. The mean of places that differ varies less
    /// than the pattern does: as much is added as they differ by.
    static HWY_INLINE hn::Vec<PixelPairBits> seen_between(hn::Vec<PixelPairBits> one, hn::Vec<PixelPairBits> other) {
        const PixelPairBits bits;
        const PixelPairHalves halves;
        const auto half = [&](hn::Vec<PixelPairBits> of)
                              HWY_ATTR { return hn::ShiftRight<1>(hn::BitCast(halves, of)); };
        const auto mean = hn::Add(half(one), half(other));
        const auto apart = hn::Abs(hn::Sub(half(one), half(other)));
        const auto more = hn::ShiftLeft<1>(hn::MulHigh(mean, apart));
        const auto pattern = hn::BitCast(halves, pair_bits(0xffff0000U));
        const auto both = hn::SaturatedAdd(mean, hn::And(more, pattern));
        const auto is_none = hn::Or(hn::Eq(one, hn::Zero(bits)), hn::Eq(other, hn::Zero(bits)));
        return hn::IfThenZeroElse(is_none, hn::BitCast(bits, both));
    }
};

/// Finds what the pairs of every second row of a tile see, and those of the row below it. Where they look is found by
/// how near the ground is for one pair in four, the first phase of rows of even number; the others look in the middle
/// of these where the ground goes on evenly from one to the other.
class TileDetailSampler {
public:
    HWY_INLINE TileDetailSampler(const TileJob& job, const TileInverseDepths& inverse_depth)
        : job_(job), inverse_depths_(inverse_depth), tile_rays_(*job.detail_texture, job.first_px),
          haze_per_depth_(job.detail_texture->haze_per_m * tile_rays_.length()) {
        for (std::size_t row = 0; row < right_edge_values_.size(); row += pairs_at_once) {
            const InverseDepthQuad near = inverse_depths_.right_of_tile(static_cast<int>(row));
            const DetailSampler look(*job_.detail_texture, tile_rays_, tile_rays_.right_of_tile(2 * row), near);
            const DetailPositions places = look.places(*job_.detail_texture, haze_per_depth_);
            right_edge_.put(places, row);
            hn::Store(sample_detail(detail_image(), places), PixelPairBits(), &right_edge_values_[row]);
        }
    }

    /// Places of a row of even number.
    HWY_NOINLINE void find(int in_tile, DetailPositionRow& detail_texture) const {
        const std::size_t row = right_edge_row(in_tile);
        for (std::size_t which = 0; which < detail_texture.value.size(); ++which) {
            detail_texture.value[which][pairs_per_phase] = right_edge_.value[which][row];
        }
        for (std::size_t i = 0; i < pairs_per_phase; i += pairs_at_once) {
            detail_texture.put(found(in_tile, 0, i), i);
        }
    }

    /// Looks up a row between two of even number; one of these is its own above and below.
    HWY_NOINLINE void look(
        int row, const DetailPositionRow& above, const DetailPositionRow& below, DetailRow& detail_texture) const {
        const DetailImage& image = detail_image();
        for (std::size_t i = 0; i < pairs_per_phase; i += pairs_at_once) {
            const bool is_found = row % 2 == 0;
            const auto even =
                sample_detail(image, is_found ? above.places(i) : interpolated_at({row, 0, i}, above, below));
            const auto odd = sample_detail(image, interpolated_at({row, 1, i}, above, below));
            hn::StoreInterleaved2(even, odd, PixelPairBits(), &detail_texture.seen[phases * i]);
        }
        detail_texture.seen[pairs_per_row] = right_edge_values_[right_edge_row(row)];
    }

private:
    /// Pairs from one on.
    struct PairStart {
        int row;
        std::size_t phase;
        std::size_t first;
    };

    std::size_t right_edge_row(int row) const {
        return static_cast<std::size_t>(std::min(row, inverse_depths_.rows() - 1));
    }

    HWY_INLINE DetailPositions found(int row, std::size_t phase, std::size_t first) const {
        const auto direction = tile_rays_.in_row(static_cast<std::size_t>(2 * row), phases * first + phase);
        const DetailSampler look(*job_.detail_texture, tile_rays_, direction, inverse_depths_.at(row, phase, first));
        return look.places(*job_.detail_texture, haze_per_depth_);
    }

    /// Of pairs in the middle of others that are found.
    HWY_INLINE DetailPositions interpolated_at(
        const PairStart& from, const DetailPositionRow& above, const DetailPositionRow& below) const {
        const PixelPairBits bits;
        const PixelPairInts whole;
        const InterpolatedPairs pairs = inverse_depths_.interpolated_at(from.row, from.phase, from.first);
        const auto is_ground = hn::RebindMask(bits, pairs.is_ground);
        const DetailPositions a = above.places(from.first);
        const DetailPositions b = above.places(from.first + from.phase);
        const DetailPositions c = below.places(from.first);
        const DetailPositions d = below.places(from.first + from.phase);
        const auto differs =
            hn::And(hn::Or(hn::Xor(a.level, b.level), hn::Or(hn::Xor(a.level, c.level), hn::Xor(a.level, d.level))),
                pair_bits(~0U << DetailPositions::scale_shift | DetailPositions::ground | DetailPositions::sides));
        const auto has_none = hn::AndNot(a.level, pair_bits(DetailPositions::ground));
        const auto is_alike =
            hn::And(hn::RebindMask(bits, pairs.is_linear), hn::Eq(hn::Or(differs, has_none), hn::Zero(bits)));
        const auto mean = [&](auto i, auto j, auto k, auto l)
                              HWY_ATTR { return hn::ShiftRight<2>(hn::Add(hn::Add(i, j), hn::Add(k, l))); };
        const auto flags = hn::And(a.level, pair_bits(7));
        const auto level = hn::AndNot(pair_bits(7), mean(a.level, b.level, c.level, d.level));
        DetailPositions places{mean(a.fine_x, b.fine_x, c.fine_x, d.fine_x),
            mean(a.fine_y, b.fine_y, c.fine_y, d.fine_y), mean(a.coarse_x, b.coarse_x, c.coarse_x, d.coarse_x),
            mean(a.coarse_y, b.coarse_y, c.coarse_y, d.coarse_y), hn::Or(level, flags),
            hn::IfThenElseZero(is_ground, mean(a.left, b.left, c.left, d.left))};
        const auto is_other = hn::AndNot(is_alike, is_ground);
        if (!hn::AllFalse(bits, is_other)) {
            const DetailPositions own = found(from.row, from.phase, from.first);
            const auto is_own = hn::RebindMask(whole, is_other);
            places.fine_x = hn::IfThenElse(is_own, own.fine_x, places.fine_x);
            places.fine_y = hn::IfThenElse(is_own, own.fine_y, places.fine_y);
            places.coarse_x = hn::IfThenElse(is_own, own.coarse_x, places.coarse_x);
            places.coarse_y = hn::IfThenElse(is_own, own.coarse_y, places.coarse_y);
            places.level = hn::IfThenElse(is_other, own.level, places.level);
            places.left = hn::IfThenElse(is_other, own.left, places.left);
        }
        return places;
    }

    const TileJob& job_;
    const TileInverseDepths& inverse_depths_;
    TileRays tile_rays_;
    float haze_per_depth_;
    // Of what lies right of the tile, by rows.
    DetailPositionRow right_edge_;
    alignas(64) std::array<std::uint32_t, tile_height / 2> right_edge_values_;
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
