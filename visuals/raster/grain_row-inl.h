// What the pixels of a row of a tile see of the fine pattern of ground: looked up at one pair of
// pixels in two, and at those between only where it is not even there.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_ROW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_ROW_INL
#undef OCTANT_RASTER_GRAIN_ROW_INL
#else
#define OCTANT_RASTER_GRAIN_ROW_INL
#endif

#include "visuals/raster/grain_places-inl.h"
#include "visuals/scene/grain_pattern.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// The pattern at places of a level of each, mixed from four texels: 2^-15, from -1 to 1.
HWY_INLINE hn::Vec<TwosWhole>
grain_of_level(const GrainImage& image, const GrainPlace& place, hn::Vec<TwosBits> level) {
    const TwosBits bits;
    const hn::Repartition<std::uint16_t, TwosBits> halves;
    const auto last = hn::Shr(twos_of(GrainImage::side - 1), level);
    const auto half_texel = twos_of(128);
    const auto x = hn::Sub(hn::Shr(place.x, level), half_texel);
    const auto y = hn::Sub(hn::Shr(place.y, level), half_texel);
    const auto column = hn::And(hn::ShiftRight<8>(x), last);
    const auto in_level = hn::And(hn::ShiftRight<8>(y), last);
    const auto first_row =
        hn::Sub(twos_of(2 * GrainImage::side), hn::Shr(twos_of(2 * GrainImage::side), level));
    const auto row = hn::Add(first_row, in_level);
    static_assert(GrainImage::stride == (1 << 9) + 1);
    const auto texel = hn::Add(hn::Add(hn::ShiftLeft<9>(row), row), column);
    const auto four = hn::GatherOffset(
        bits,
        reinterpret_cast<const std::uint32_t*>(image.texels()),
        hn::BitCast(TwosWhole(), hn::Add(texel, texel)));
    const auto byte_of_each = twos_of(0x00ff00ff);
    const auto own = hn::BitCast(halves, hn::And(four, byte_of_each));
    const auto above = hn::BitCast(halves, hn::And(hn::ShiftRight<8>(four), byte_of_each));
    const auto up = hn::And(y, twos_of(0xff));
    const auto ups = hn::BitCast(halves, hn::Or(up, hn::ShiftLeft<16>(up)));
    const auto both = hn::BitCast(
        bits,
        hn::Add(
            hn::Mul(own, hn::Sub(hn::Set(halves, std::uint16_t{256}), ups)), hn::Mul(above, ups)));
    const auto left = hn::BitCast(TwosWhole(), hn::And(both, twos_of(0xffff)));
    const auto right = hn::BitCast(TwosWhole(), hn::ShiftRight<16>(both));
    const auto rightwards = hn::BitCast(TwosWhole(), hn::And(x, twos_of(0xff)));
    const auto mean = hn::Add(left, hn::ShiftRight<8>(hn::Mul(hn::Sub(right, left), rightwards)));
    return hn::Sub(mean, hn::Set(TwosWhole(), 128 * 256));
}

/// Both scales of the pattern together. The squares of their shares are about one, so that the
/// contrast stays while one gives way to the other.
HWY_INLINE hn::Vec<TwosWhole> grain_of(const GrainImage& image, const GrainPlaces& places) {
    const TwosWhole whole;
    const auto share_of = [&](hn::Vec<TwosWhole> value, hn::Vec<TwosWhole> share)
                              HWY_ATTR { return hn::ShiftRight<8>(hn::Mul(value, share)); };
    auto fine = grain_of_level(image, places.fine, places.level);
    const auto coarse = grain_of_level(image, places.coarse, hn::Zero(TwosBits()));
    if (!hn::AllTrue(TwosBits(), hn::Eq(places.next_level, hn::Zero(TwosBits())))) {
        const auto next = grain_of_level(image, places.fine, hn::Add(places.level, twos_of(1)));
        fine = hn::Add(fine, share_of(hn::Sub(next, fine), hn::BitCast(whole, places.next_level)));
    }
    const auto all = hn::Set(whole, 256);
    const auto through = hn::BitCast(whole, places.through);
    const auto left = hn::Sub(all, through);
    const auto both = hn::Add(
        share_of(fine, hn::Sub(all, share_of(through, through))),
        share_of(coarse, hn::Sub(all, share_of(left, left))));
    return hn::Min(hn::Max(both, hn::Set(whole, -32768)), hn::Set(whole, 32767));
}

/// What pairs of pixels see: in the upper half the pattern at the first one's place, 2^-15, in the
/// lower half what the haze leaves of it, likewise; 0: no ground.
HWY_INLINE hn::Vec<TwosBits>
grain_seen(const GrainRays& rays, const GrainLook& look, float haze_per_depth) {
    const auto pattern = hn::BitCast(TwosBits(), grain_of(grain_image(), look.places()));
    const auto seen = hn::Or(hn::ShiftLeft<16>(pattern), look.left(rays, haze_per_depth));
    return hn::IfThenElseZero(hn::RebindMask(TwosBits(), look.is_ground()), seen);
}

/// What a row's pairs of pixels see, and what the one beside it does.
struct GrainRow {
    alignas(64) std::array<std::uint32_t, twos_a_row + 16> seen;

    HWY_INLINE hn::Vec<TwosWhole> at(std::size_t two) const {
        return hn::LoadU(TwosWhole(), reinterpret_cast<const std::int32_t*>(&seen[two]));
    }
};

/// In the middle between pairs that see ground; none between others. The mean of places that differ
/// varies less than the pattern does: as much is added as they differ by.
HWY_INLINE hn::Vec<TwosBits> seen_between(hn::Vec<TwosBits> one, hn::Vec<TwosBits> other) {
    const TwosBits bits;
    const TwosHalves halves;
    const auto half = [&](hn::Vec<TwosBits> seen)
                          HWY_ATTR { return hn::ShiftRight<1>(hn::BitCast(halves, seen)); };
    const auto mean = hn::Add(half(one), half(other));
    const auto apart = hn::Abs(hn::Sub(half(one), half(other)));
    const auto more = hn::ShiftLeft<1>(hn::MulHigh(mean, apart));
    const auto pattern = hn::BitCast(halves, twos_of(0xffff0000U));
    const auto both = hn::SaturatedAdd(mean, hn::And(more, pattern));
    const auto is_none = hn::Or(hn::Eq(one, hn::Zero(bits)), hn::Eq(other, hn::Zero(bits)));
    return hn::IfThenZeroElse(is_none, hn::BitCast(bits, both));
}

/// Every second pair of a row, and the one after them.
using OfPhase = std::array<std::uint32_t, twos_a_phase + 16>;

/// Finds what the pairs of every second row of a tile see.
class RowLook {
public:
    HWY_INLINE RowLook(const TileJob& job, const TileNearness& nearness)
        : job_(job)
        , nearness_(nearness)
        , haze_per_depth_(job.grain->haze_per_m * GrainWays(*job.grain, job.first_px).length()) {
        const GrainWays ways(*job.grain, job.first_px);
        for (std::size_t row = 0; row < beside_.size(); row += twos_at_once) {
            const Nearness near = nearness.beside(static_cast<int>(row));
            const GrainWay way{
                ways.part[0].beside(2 * row),
                ways.part[1].beside(2 * row),
                ways.part[2].beside(2 * row)};
            const GrainLook look(*job.grain, ways, way, near);
            hn::StoreU(grain_seen(*job.grain, look, haze_per_depth_), TwosBits(), &beside_[row]);
        }
    }

    HWY_INLINE void at(int row, GrainRow& grain) const {
        alignas(64) OfPhase even;
        alignas(64) OfPhase odd{};
        const int in_tile = std::min(row, nearness_.rows() - 1);
        even[twos_a_phase] = beside_[static_cast<std::size_t>(in_tile)];
        alignas(64) OfPhase between;
        if (!put_between(even, look(row, 0, even), between)) {
            look(row, 1, odd);
        }
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            const auto own = hn::LoadU(TwosBits(), &odd[i]);
            const auto mean = hn::LoadU(TwosBits(), &between[i]);
            const auto has_mean = hn::Ne(mean, hn::Zero(TwosBits()));
            hn::StoreU(hn::IfThenElse(has_mean, mean, own), TwosBits(), &odd[i]);
        }
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            hn::StoreInterleaved2(
                hn::LoadU(TwosBits(), &even[i]),
                hn::LoadU(TwosBits(), &odd[i]),
                TwosBits(),
                &grain.seen[2 * i]);
        }
        grain.seen[twos_a_row] = even[twos_a_phase];
    }

    /// Between two rows.
    static HWY_INLINE void between(const GrainRow& above, const GrainRow& below, GrainRow& grain) {
        for (std::size_t two = 0; two < twos_a_row; two += twos_at_once) {
            const auto of = [&](const GrainRow& row)
                                HWY_ATTR { return hn::LoadU(TwosBits(), &row.seen[two]); };
            hn::StoreU(seen_between(of(above), of(below)), TwosBits(), &grain.seen[two]);
        }
        grain.seen[twos_a_row] = below.seen[twos_a_row];
    }

private:
    /// A bit for each pair that sees ground which is even to the next one of its phase.
    HWY_NOINLINE std::uint32_t look(int row, std::size_t phase, OfPhase& to) const {
        std::uint32_t even = 0;
        const GrainWays ways(*job_.grain, job_.first_px + glm::ivec2(0, 2 * row));
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            const Nearness near = nearness_.at(row, phase, i);
            auto seen = hn::Zero(TwosBits());
            if (!hn::AllFalse(Twos(), hn::Gt(near.here, hn::Zero(Twos())))) {
                const std::size_t two = phases * i + phase;
                const GrainWay way{
                    ways.part[0].in_row(two), ways.part[1].in_row(two), ways.part[2].in_row(two)};
                const GrainLook look(*job_.grain, ways, way, near);
                seen = grain_seen(*job_.grain, look, haze_per_depth_);
                alignas(8) std::array<std::uint8_t, 8> bits{};
                hn::StoreMaskBits(Twos(), look.is_even(), bits.data());
                constexpr std::uint32_t all = (1U << twos_at_once) - 1;
                even |= ((bits[0] | static_cast<std::uint32_t>(bits[1]) << 8U) & all) << i;
            }
            hn::StoreU(seen, TwosBits(), &to[i]);
        }
        return even;
    }

    /// Between pairs of a phase that see ground, where the first of two is even; whether all are.
    static HWY_INLINE bool put_between(const OfPhase& from, std::uint32_t even, OfPhase& to) {
        const TwosBits bits;
        bool all = true;
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            const auto which =
                hn::And(twos_of(even >> i), hn::Shl(twos_of(1), counting_from(bits, 0)));
            const auto mean =
                seen_between(hn::LoadU(bits, &from[i]), hn::LoadU(bits, &from[i + 1]));
            const auto is_none = hn::Eq(which, hn::Zero(bits));
            const auto seen = hn::IfThenZeroElse(is_none, mean);
            all = all && hn::AllTrue(bits, hn::Ne(seen, hn::Zero(bits)));
            hn::StoreU(seen, bits, &to[i]);
        }
        return all;
    }

    const TileJob& job_;
    const TileNearness& nearness_;
    float haze_per_depth_;
    alignas(64) std::array<std::uint32_t, tile_height / 2> beside_; ///< of what lies right of it
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
