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
    static_assert(GrainImage::stride == (1 << 10) + 1);
    const auto texel = hn::Add(hn::Add(hn::ShiftLeft<10>(row), row), column);
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

/// What is known of a row's pairs of pixels and of the one beside it: first where they look in the
/// pattern, then, in `x`, the pattern there.
struct GrainRow {
    using Numbers = std::array<std::uint32_t, twos_a_row>;
    using NumbersAndOne = std::array<std::uint32_t, twos_a_row + 4>;
    static constexpr std::uint32_t is_ground = 0x8000;

    alignas(64) NumbersAndOne x;
    alignas(64) NumbersAndOne left; ///< by the haze, and whether there is ground; 0 = none
    alignas(64) Numbers y;
    Numbers coarse_x;
    Numbers coarse_y;
    Numbers how; ///< level, share of the next level, how far the levels are gone through

    HWY_INLINE void look(
        std::size_t two,
        const GrainRays& rays,
        const GrainWays& ways,
        const GrainWay& way,
        const Nearness& near) {
        const TwosBits bits;
        const GrainLook look(rays, ways, way, near);
        const GrainPlaces& places = look.places();
        const auto ground = hn::RebindMask(bits, hn::Gt(near.here, hn::Zero(Twos())));
        const auto levels = hn::Or(hn::ShiftLeft<16>(places.level), places.next_level);
        hn::StoreU(places.fine.x, bits, &x[two]);
        hn::StoreU(places.fine.y, bits, &y[two]);
        hn::StoreU(places.coarse.x, bits, &coarse_x[two]);
        hn::StoreU(places.coarse.y, bits, &coarse_y[two]);
        hn::StoreU(hn::Or(levels, hn::ShiftLeft<8>(places.through)), bits, &how[two]);
        hn::StoreU(
            hn::IfThenElseZero(ground, hn::Or(look.left(rays), twos_of(is_ground))),
            bits,
            &left[two]);
    }

    HWY_INLINE GrainPlaces places(std::size_t two) const {
        const TwosBits bits;
        const auto here = hn::LoadU(bits, &how[two]);
        return {
            {hn::LoadU(bits, &x[two]), hn::LoadU(bits, &y[two])},
            {hn::LoadU(bits, &coarse_x[two]), hn::LoadU(bits, &coarse_y[two])},
            hn::ShiftRight<16>(here),
            hn::And(here, twos_of(0xff)),
            hn::And(hn::ShiftRight<8>(here), twos_of(0xff))};
    }

    /// All bits where there is any, else none.
    HWY_INLINE hn::Vec<TwosBits> ground(std::size_t two) const {
        const auto here = hn::And(hn::LoadU(TwosBits(), &left[two]), twos_of(is_ground));
        return hn::Sub(hn::Zero(TwosBits()), hn::ShiftRight<15>(here));
    }
};

using TwosHalves = hn::Repartition<std::int16_t, TwosBits>;

/// By how much each part of the colours of pairs of pixels changes, 2^-15 of itself.
struct ContrastOfTwos {
    std::array<hn::Vec<TwosHalves>, 3> part;

    /// `numbers`: those of the pixels' covers, 2^-8.
    HWY_INLINE ContrastOfTwos(
        const GrainRow& grain,
        std::size_t two,
        hn::Vec<TwosBits> numbers,
        const std::uint32_t* table) {
        const TwosBits bits;
        const TwosWhole whole;
        const auto here = hn::LoadU(whole, reinterpret_cast<const std::int32_t*>(&grain.x[two]));
        const auto beside =
            hn::LoadU(whole, reinterpret_cast<const std::int32_t*>(&grain.x[two + 1]));
        const auto ground = hn::BitCast(whole, grain.ground(two + 1));
        const auto next = hn::Or(hn::And(beside, ground), hn::AndNot(ground, here));
        const auto between = hn::ShiftRight<1>(hn::Add(here, next));
        static_assert(scene::CoverContrast::patterns == 64 && scene::CoverContrast::kinds == 128);
        const auto entry = [&](hn::Vec<TwosBits> kind, hn::Vec<TwosWhole> pattern) HWY_ATTR {
            const auto column = hn::ShiftRight<10>(hn::Add(pattern, hn::Set(whole, 32768)));
            const auto at = hn::Or(hn::ShiftLeft<6>(kind), hn::BitCast(bits, column));
            return hn::GatherIndex(bits, table, hn::BitCast(whole, at));
        };
        const auto first = entry(hn::And(hn::ShiftRight<9>(numbers), twos_of(0x7f)), here);
        const auto second = entry(hn::ShiftRight<25>(numbers), between);
        const auto low = twos_of(0xffc0);
        const auto high = twos_of(0xffc00000U);
        const auto both = [&](hn::Vec<TwosBits> of_first, hn::Vec<TwosBits> of_second) HWY_ATTR {
            return hn::BitCast(
                TwosHalves(), hn::Or(hn::And(of_first, low), hn::And(of_second, high)));
        };
        part[0] = both(hn::ShiftRight<16>(first), second);
        part[1] = both(hn::ShiftRight<6>(first), hn::ShiftLeft<10>(second));
        part[2] = both(hn::ShiftLeft<4>(first), hn::ShiftLeft<20>(second));
    }
};

/// Changes colours of a row of pixels from `first` on by the pattern.
HWY_INLINE void change_row(
    const GrainRow& grain, const std::uint32_t* table, std::size_t first, TileBuffer& buffer) {
    const TwosHalves halves;
    const hn::RebindToUnsigned<TwosHalves> values;
    const auto white = hn::Set(values, std::uint16_t{255 * 256});
    for (std::size_t two = 0; two < twos_a_row; two += twos_at_once) {
        const std::size_t at = first + 2 * two;
        const auto numbers = hn::LoadU(values, buffer.sums[3].data() + at);
        const ContrastOfTwos contrast(grain, two, hn::BitCast(TwosBits(), numbers), table);
        const auto left = hn::And(hn::LoadU(TwosBits(), &grain.left[two]), twos_of(0x7fff));
        const auto left_of_both = hn::BitCast(halves, hn::Or(left, hn::ShiftLeft<16>(left)));
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data() + at;
            const auto own = hn::LoadU(values, sums);
            const auto half_own = hn::BitCast(halves, hn::ShiftRight<1>(own));
            const auto seen = hn::ShiftLeft<1>(hn::MulHigh(contrast.part[k], left_of_both));
            const auto quarter = hn::MulHigh(half_own, seen);
            const auto times_four = [&](hn::Vec<TwosHalves> value) HWY_ATTR {
                return hn::ShiftLeft<2>(hn::BitCast(values, hn::Max(value, hn::Zero(halves))));
            };
            const auto brighter = hn::Min(hn::SaturatedAdd(own, times_four(quarter)), white);
            hn::StoreU(hn::SaturatedSub(brighter, times_four(hn::Neg(quarter))), values, sums);
        }
    }
}

constexpr std::size_t parts_a_row = twos_a_row / twos_at_once;

/// Where the pairs of a row of a tile look in the pattern, a bit for each few that have any
/// ground.
HWY_INLINE std::uint32_t
look_at_row(const TileJob& job, const TileBuffer& buffer, int row, GrainRow& grain) {
    const GrainWays ways(*job.grain, job.first_px + glm::ivec2(0, row));
    const float* const near = buffer.nearness.data() + static_cast<std::size_t>(row) * tile_width;
    const float* const below = row + 1 < job.size_px.y ? near + tile_width : near;
    const float* const above = row > 0 ? near - tile_width : near;
    std::uint32_t parts = 0;
    for (std::size_t part = 0; part < parts_a_row; ++part) {
        const std::size_t two = part * twos_at_once;
        const Nearness nearness = nearness_of_row(near + 2 * two, above + 2 * two, below + 2 * two);
        if (hn::AllTrue(Twos(), hn::Eq(nearness.here, hn::Zero(Twos())))) {
            hn::StoreU(hn::Zero(TwosBits()), TwosBits(), &grain.left[two]);
            continue;
        }
        parts |= std::uint32_t{1} << part;
        const GrainWay way{
            ways.part[0].in_row(two), ways.part[1].in_row(two), ways.part[2].in_row(two)};
        grain.look(two, *job.grain, ways, way, nearness);
    }
    return parts;
}

/// The same of the pairs right of a tile, one of each row, where the ground goes on as it ends.
HWY_INLINE std::uint32_t
look_beside(const TileJob& job, const TileBuffer& buffer, GrainRow& grain) {
    static_assert(tile_height <= twos_a_row);
    std::array<float, twos_a_row> here{};
    std::array<float, twos_a_row> across{};
    std::array<float, twos_a_row> down{};
    const auto rows = static_cast<std::size_t>(job.size_px.y);
    for (std::size_t row = 0; row < rows; ++row) {
        const float* const last = &buffer.nearness[row * tile_width + tile_width - 2];
        const bool is_last = row + 1 == rows;
        const float other = is_last && row > 0 ? *(last - tile_width) : *(last + tile_width);
        if (std::min(last[0], last[1]) > 0.0F) {
            across[row] = last[1] - last[0];
            here[row] = last[1] + std::max(across[row], across[row] + across[row]);
            const float step = other > 0.0F ? other - last[0] : 0.0F;
            down[row] = is_last ? -step : step;
        }
    }
    const GrainWays ways(*job.grain, job.first_px);
    for (std::size_t row = 0; row < twos_a_row; row += twos_at_once) {
        const Nearness nearness{
            hn::LoadU(Twos(), &here[row]),
            hn::LoadU(Twos(), &across[row]),
            hn::LoadU(Twos(), &down[row])};
        const GrainWay way{
            ways.part[0].beside(row), ways.part[1].beside(row), ways.part[2].beside(row)};
        grain.look(row, *job.grain, ways, way, nearness);
    }
    return (std::uint32_t{1} << parts_a_row) - 1;
}

/// Puts the pattern in the places' stead.
HWY_INLINE void find_in_row(std::uint32_t parts, GrainRow& grain) {
    const GrainImage& image = grain_image();
    for (std::size_t part = 0; part < parts_a_row; ++part) {
        const std::size_t two = part * twos_at_once;
        auto seen = hn::Zero(TwosWhole());
        if ((parts >> part & 1U) != 0) {
            seen = grain_of(image, grain.places(two));
        }
        hn::StoreU(hn::BitCast(TwosBits(), seen), TwosBits(), &grain.x[two]);
    }
}

/// Changes what a tile's pixels have summed up by the fine pattern, where its triangles are
/// painted. Each step is done for all rows before the next one: within a step no row waits for
/// another.
HWY_NOINLINE void add_grain(const TileJob& job, TileBuffer& buffer) {
    std::array<GrainRow, tile_height> grain;
    std::array<std::uint32_t, tile_height> parts{};
    std::uint32_t any = 0;
    const auto rows = static_cast<std::size_t>(job.size_px.y);
    for (std::size_t row = 0; row < rows; ++row) {
        parts[row] = look_at_row(job, buffer, static_cast<int>(row), grain[row]);
        any |= parts[row];
    }
    if (any == 0) {
        return;
    }
    GrainRow beside;
    find_in_row(look_beside(job, buffer, beside), beside);
    for (std::size_t row = 0; row < rows; ++row) {
        if (parts[row] != 0) {
            find_in_row(parts[row], grain[row]);
        }
    }
    for (std::size_t row = 0; row < rows; ++row) {
        if (parts[row] != 0) {
            grain[row].x[twos_a_row] = beside.x[row];
            grain[row].left[twos_a_row] = beside.left[row];
            change_row(grain[row], job.grain->contrast, row * tile_width, buffer);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
