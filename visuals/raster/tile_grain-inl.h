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
#include "visuals/raster/grain_places-inl.h"
#include "visuals/raster/strip_level-inl.h"
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

/// Every second pair of a row, and the one beside the row.
using EverySecond = std::array<std::uint32_t, twos_a_row / 2 + 16>;

/// Finds what every second pair of a row of a tile sees, from one on.
struct RowLook {
    bool any = false;    ///< of them sees ground
    bool is_even = true; ///< all of them do, and what lies between is even

    HWY_INLINE RowLook(
        const TileJob& job,
        const TileBuffer& buffer,
        const glm::ivec2& first_two,
        float haze_per_depth,
        std::uint32_t* to) {
        const int row = first_two.y;
        const GrainWays ways(*job.grain, job.first_px + glm::ivec2(0, row));
        for (std::size_t i = 0; i < twos_a_row / 2; i += twos_at_once) {
            const std::size_t two = static_cast<std::size_t>(first_two.x) + 2 * i;
            const Nearness near = nearness_of_row(job, buffer, row, two);
            const auto is_ground = hn::Gt(near.here, hn::Zero(Twos()));
            auto seen = hn::Zero(TwosBits());
            if (hn::AllFalse(Twos(), is_ground)) {
                is_even = false;
            } else {
                const GrainWay way{
                    ways.part[0].in_row(two), ways.part[1].in_row(two), ways.part[2].in_row(two)};
                const GrainLook look(*job.grain, ways, way, near);
                seen = grain_seen(*job.grain, look, haze_per_depth);
                any = true;
                is_even = is_even && look.is_even() && hn::AllTrue(Twos(), is_ground);
            }
            hn::StoreU(seen, TwosBits(), to + i);
        }
    }
};

/// Between neighbours that see ground, in both halves.
HWY_INLINE void put_between(const EverySecond& from, EverySecond& to) {
    const TwosBits bits;
    const auto lower = twos_of(0xffff);
    for (std::size_t i = 0; i < twos_a_row / 2; i += twos_at_once) {
        const auto before = hn::LoadU(bits, &from[i]);
        const auto beside = hn::LoadU(bits, &from[i + 1]);
        const auto after = hn::IfThenElse(hn::Eq(beside, hn::Zero(bits)), before, beside);
        const auto pattern = hn::ShiftRight<1>(hn::Add(
            hn::ShiftRight<16>(hn::BitCast(TwosWhole(), before)),
            hn::ShiftRight<16>(hn::BitCast(TwosWhole(), after))));
        const auto left = hn::ShiftRight<1>(hn::Add(hn::And(before, lower), hn::And(after, lower)));
        hn::StoreU(hn::Or(hn::ShiftLeft<16>(hn::BitCast(bits, pattern)), left), bits, &to[i]);
    }
}

/// Whether all pairs of a row may see ground.
HWY_INLINE bool is_ground_row(const TileBuffer& buffer, int row) {
    const Twos real;
    const float* const near = buffer.nearness_of_row(row);
    auto least = hn::LoadU(real, near);
    for (std::size_t two = twos_at_once; two < twos_a_row; two += twos_at_once) {
        least = hn::Min(least, hn::LoadU(real, near + two));
    }
    return hn::AllTrue(real, hn::Gt(least, hn::Zero(real)));
}

/// Finds what the pairs of a row of a tile see, the one beside it known; whether any sees ground.
/// Pairs between others are looked at where that is worth it.
HWY_INLINE bool look_at_row(
    const TileJob& job, const TileBuffer& buffer, int row, float haze_per_depth, GrainRow& grain) {
    alignas(64) EverySecond even;
    alignas(64) EverySecond odd;
    const RowLook first(job, buffer, {0, row}, haze_per_depth, even.data());
    bool any = first.any;
    if (first.is_even && is_ground_row(buffer, row)) {
        even[twos_a_row / 2] = grain.seen[twos_a_row];
        put_between(even, odd);
    } else {
        any |= RowLook(job, buffer, {1, row}, haze_per_depth, odd.data()).any;
    }
    for (std::size_t i = 0; i < twos_a_row / 2; i += twos_at_once) {
        hn::StoreInterleaved2(
            hn::LoadU(TwosBits(), &even[i]),
            hn::LoadU(TwosBits(), &odd[i]),
            TwosBits(),
            &grain.seen[2 * i]);
    }
    return any;
}

/// The same of the pixels right of a tile, one of each row, where the ground goes on as it ends.
HWY_INLINE void
look_beside(const TileJob& job, const TileBuffer& buffer, float haze_per_depth, GrainRow& grain) {
    static_assert(tile_height <= twos_a_row);
    std::array<float, twos_a_row> here{};
    std::array<float, twos_a_row> across{};
    std::array<float, twos_a_row> down{};
    for (int row = 0; row < job.size_px.y; ++row) {
        const auto at = static_cast<std::size_t>(row);
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
    for (std::size_t row = 0; row < twos_a_row; row += twos_at_once) {
        const Nearness near{
            hn::LoadU(Twos(), &here[row]),
            hn::LoadU(Twos(), &across[row]),
            hn::LoadU(Twos(), &down[row])};
        const GrainWay way{
            ways.part[0].beside(row), ways.part[1].beside(row), ways.part[2].beside(row)};
        const GrainLook look(*job.grain, ways, way, near);
        hn::StoreU(grain_seen(*job.grain, look, haze_per_depth), TwosBits(), &grain.seen[row]);
    }
}

HWY_INLINE bool has_ground(const TileBuffer& buffer) {
    const Twos real;
    auto most = hn::Zero(real);
    for (int row = 0; row < tile_height; ++row) {
        const float* const near = buffer.nearness_of_row(row);
        for (std::size_t two = 0; two < twos_a_row; two += twos_at_once) {
            most = hn::Max(most, hn::LoadU(real, near + two));
        }
    }
    return !hn::AllTrue(real, hn::Eq(most, hn::Zero(real)));
}

/// Changes what a tile's pixels have summed up by the fine pattern, where its triangles are
/// painted.
HWY_NOINLINE void add_grain(const TileJob& job, TileBuffer& buffer) {
    if (!has_ground(buffer)) {
        return;
    }
    const float haze_per_depth =
        job.grain->haze_per_m * GrainWays(*job.grain, job.first_px).length();
    GrainRow beside;
    look_beside(job, buffer, haze_per_depth, beside);
    GrainRow grain;
    for (int row = 0; row < job.size_px.y; ++row) {
        const auto at = static_cast<std::size_t>(row);
        grain.seen[twos_a_row] = beside.seen[at];
        if (look_at_row(job, buffer, row, haze_per_depth, grain)) {
            change_row(grain, job.grain->contrast, at * tile_width, buffer);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
