// What the pixels of a row of a tile see of the fine pattern of ground: looked up at one pair of
// pixels in four, and at those between only where it is not even there.
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
grain_of_level(const std::uint16_t* texels, const GrainPlace& place, hn::Vec<TwosBits> level) {
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
    static_assert(GrainImage::stride == (1 << 8) + 1);
    const auto texel = hn::Add(hn::Add(hn::ShiftLeft<8>(row), row), column);
    const auto four = hn::GatherOffset(
        bits,
        reinterpret_cast<const std::uint32_t*>(texels),
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
HWY_INLINE hn::Vec<TwosWhole> grain_of(const std::uint16_t* texels, const GrainPlaces& places) {
    const TwosWhole whole;
    const auto share_of = [&](hn::Vec<TwosWhole> value, hn::Vec<TwosWhole> share)
                              HWY_ATTR { return hn::ShiftRight<8>(hn::Mul(value, share)); };
    auto fine = grain_of_level(texels, places.fine, places.level);
    const auto coarse = grain_of_level(texels, places.coarse, hn::Zero(TwosBits()));
    if (!hn::AllTrue(TwosBits(), hn::Eq(places.next_level, hn::Zero(TwosBits())))) {
        const auto next = grain_of_level(texels, places.fine, hn::Add(places.level, twos_of(1)));
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
    const auto pattern = hn::BitCast(TwosBits(), grain_of(rays.texels, look.places()));
    const auto seen = hn::Or(hn::ShiftLeft<16>(pattern), look.left(rays, haze_per_depth));
    return hn::IfThenElseZero(hn::RebindMask(TwosBits(), look.is_ground()), seen);
}

/// What a row's pairs of pixels see, and what the one beside it does.
struct GrainRow {
    alignas(64) std::array<std::uint32_t, twos_a_row + 4> seen;

    HWY_INLINE hn::Vec<TwosWhole> at(std::size_t two) const {
        return hn::LoadU(TwosWhole(), reinterpret_cast<const std::int32_t*>(&seen[two]));
    }
};

using TwosHalves = hn::Repartition<std::int16_t, TwosBits>;

/// In the middle between pairs that see ground. The mean of places that differ varies less than the
/// pattern does: as much is added as they differ by.
HWY_INLINE hn::Vec<TwosBits> seen_between(hn::Vec<TwosBits> one, hn::Vec<TwosBits> other) {
    const TwosHalves halves;
    const auto half = [&](hn::Vec<TwosBits> seen)
                          HWY_ATTR { return hn::ShiftRight<1>(hn::BitCast(halves, seen)); };
    const auto mean = hn::Add(half(one), half(other));
    const auto apart = hn::Abs(hn::Sub(half(one), half(other)));
    const auto more = hn::ShiftLeft<1>(hn::MulHigh(mean, apart));
    const auto pattern = hn::BitCast(halves, twos_of(0xffff0000U));
    return hn::BitCast(TwosBits(), hn::SaturatedAdd(mean, hn::And(more, pattern)));
}

/// Every fourth pair of a row, and the one after them.
using OfPhase = std::array<std::uint32_t, twos_a_phase + 8>;

/// Finds what the pairs of rows of a tile see.
class RowLook {
public:
    HWY_INLINE RowLook(const TileJob& job, const TileNearness& nearness, const GrainRow& beside)
        : job_(job)
        , nearness_(nearness)
        , beside_(beside)
        , haze_per_depth_(job.grain->haze_per_m * GrainWays(*job.grain, job.first_px).length()) {}

    HWY_INLINE void at(int row, GrainRow& grain) const {
        alignas(64) std::array<OfPhase, phases> seen;
        const std::uint32_t next = beside_.seen[static_cast<std::size_t>(row)];
        Evenness even = look(row, 0, seen[0]);
        seen[0][twos_a_phase] = next;
        const bool is_inside = nearness_.is_inside(row);
        if (is_inside && even.over_eight && even.is_one_side()) {
            put_between(seen[0], seen[0].data() + 1, seen[2]);
        } else {
            even.narrow(look(row, 2, seen[2]));
        }
        if (is_inside && even.over_four && even.is_one_side()) {
            put_between(seen[0], seen[2].data(), seen[1]);
            put_between(seen[2], seen[0].data() + 1, seen[3]);
        } else {
            look(row, 1, seen[1]);
            look(row, 3, seen[3]);
        }
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            const auto of = [&](std::size_t phase)
                                HWY_ATTR { return hn::LoadU(TwosBits(), &seen[phase][i]); };
            hn::StoreInterleaved4(of(0), of(1), of(2), of(3), TwosBits(), &grain.seen[phases * i]);
        }
        grain.seen[twos_a_row] = next;
    }

    /// Between two rows that see ground.
    static HWY_INLINE void between(const GrainRow& above, const GrainRow& below, GrainRow& grain) {
        for (std::size_t two = 0; two < twos_a_row; two += twos_at_once) {
            const auto of = [&](const GrainRow& row)
                                HWY_ATTR { return hn::LoadU(TwosBits(), &row.seen[two]); };
            hn::StoreU(seen_between(of(above), of(below)), TwosBits(), &grain.seen[two]);
        }
        grain.seen[twos_a_row] = below.seen[twos_a_row];
    }

    float haze_per_depth() const { return haze_per_depth_; }

private:
    HWY_NOINLINE Evenness look(int row, std::size_t phase, OfPhase& to) const {
        Evenness even;
        const GrainWays ways(*job_.grain, job_.first_px + glm::ivec2(0, row));
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            const Nearness near = nearness_.at(row, phase, i);
            auto seen = hn::Zero(TwosBits());
            if (!hn::AllFalse(Twos(), hn::Gt(near.here, hn::Zero(Twos())))) {
                const std::size_t first = phases * i + phase;
                const GrainWay way{
                    ways.part[0].in_row(first),
                    ways.part[1].in_row(first),
                    ways.part[2].in_row(first)};
                const GrainLook look(*job_.grain, ways, way, near);
                seen = grain_seen(*job_.grain, look, haze_per_depth_);
                even.narrow(look.evenness());
            } else {
                even.over_eight = false;
                even.over_four = false;
            }
            hn::StoreU(seen, TwosBits(), &to[i]);
        }
        return even;
    }

    static HWY_INLINE void
    put_between(const OfPhase& one, const std::uint32_t* other, OfPhase& to) {
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            hn::StoreU(
                seen_between(hn::LoadU(TwosBits(), &one[i]), hn::LoadU(TwosBits(), other + i)),
                TwosBits(),
                &to[i]);
        }
    }

    const TileJob& job_;
    const TileNearness& nearness_;
    const GrainRow& beside_;
    float haze_per_depth_;
};

/// What the pixels right of a tile see, one of each row, where the ground goes on as it ends:
/// looked up in every second row.
HWY_INLINE void
look_beside(const TileJob& job, const TileBuffer& buffer, float haze_per_depth, GrainRow& grain) {
    constexpr std::size_t looks = tile_height / 2;
    static_assert(tile_height <= twos_a_row && looks % twos_at_once == 0);
    std::array<float, looks> here{};
    std::array<float, looks> across{};
    std::array<float, looks> down{};
    for (int row = 0; row < job.size_px.y; row += 2) {
        const auto at = static_cast<std::size_t>(row / 2);
        const float* const last = buffer.nearness_of_row(row) + twos_a_row - 1;
        const bool is_last = row + 1 == job.size_px.y;
        const float other = is_last && row > 0 ? *(last - twos_a_row) : *(last + twos_a_row);
        if (std::min(last[0], last[-1]) > 0.0F) {
            across[at] = 0.5F * (last[0] - last[-1]);
            here[at] = last[0] + 2.0F * across[at];
            const float step = other > 0.0F ? other - last[0] : 0.0F;
            down[at] = is_last ? -step : step;
        }
    }
    const GrainWays ways(*job.grain, job.first_px);
    alignas(64) std::array<std::uint32_t, looks + 8> seen{};
    for (std::size_t i = 0; i < looks; i += twos_at_once) {
        const Nearness near{
            hn::LoadU(Twos(), &here[i]),
            hn::LoadU(Twos(), &across[i]),
            hn::LoadU(Twos(), &down[i])};
        const GrainWay way{
            ways.part[0].beside(2 * i), ways.part[1].beside(2 * i), ways.part[2].beside(2 * i)};
        const GrainLook look(*job.grain, ways, way, near);
        hn::StoreU(grain_seen(*job.grain, look, haze_per_depth), TwosBits(), &seen[i]);
    }
    seen[looks] = seen[looks - 1];
    for (std::size_t i = 0; i < looks; i += twos_at_once) {
        const auto own = hn::LoadU(TwosBits(), &seen[i]);
        const auto next = hn::LoadU(TwosBits(), &seen[i + 1]);
        const auto zero = hn::Zero(TwosBits());
        const auto is_none = hn::Or(hn::Eq(own, zero), hn::Eq(next, zero));
        hn::StoreInterleaved2(
            own,
            hn::IfThenZeroElse(is_none, seen_between(own, next)),
            TwosBits(),
            &grain.seen[2 * i]);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
