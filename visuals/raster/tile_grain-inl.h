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
grain_of_level(const GrainImage& image, const GrainPlaces& places, hn::Vec<TwosBits> level) {
    const TwosBits bits;
    const hn::Repartition<std::uint16_t, TwosBits> halves;
    const auto last = hn::Shr(twos_of(GrainImage::side - 1), level);
    const auto half_texel = twos_of(128);
    const auto x = hn::Sub(hn::Shr(places.x, level), half_texel);
    const auto y = hn::Sub(hn::Shr(places.y, level), half_texel);
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

HWY_INLINE hn::Vec<TwosWhole> grain_of(const GrainImage& image, const GrainPlaces& places) {
    const auto fine = grain_of_level(image, places, places.level);
    if (hn::AllTrue(TwosBits(), hn::Eq(places.coarse, hn::Zero(TwosBits())))) {
        return fine;
    }
    const auto coarse = grain_of_level(image, places, hn::Add(places.level, twos_of(1)));
    const auto share = hn::BitCast(TwosWhole(), places.coarse);
    return hn::Add(fine, hn::ShiftRight<8>(hn::Mul(hn::Sub(coarse, fine), share)));
}

/// What is known of a row's pairs of pixels and of the one beside it: first where they look in the
/// pattern, then, in `x`, the pattern there.
struct GrainRow {
    using Numbers = std::array<std::uint32_t, twos_a_row + twos_at_once>;
    static constexpr std::uint32_t is_ground = 0x100;

    alignas(64) Numbers x;
    Numbers y;
    Numbers how; ///< share of the coarser level, whether there is ground, level; 0 = no ground

    HWY_INLINE void set(std::size_t two, const GrainPlaces& places) {
        const auto ground = hn::And(places.ground, twos_of(is_ground));
        const auto levels = hn::Or(hn::ShiftLeft<9>(places.level), places.coarse);
        hn::StoreU(places.x, TwosBits(), &x[two]);
        hn::StoreU(places.y, TwosBits(), &y[two]);
        hn::StoreU(hn::Or(levels, ground), TwosBits(), &how[two]);
    }

    HWY_INLINE GrainPlaces places(std::size_t two) const {
        const TwosBits bits;
        const auto here = hn::LoadU(bits, &how[two]);
        return {
            hn::LoadU(bits, &x[two]),
            hn::LoadU(bits, &y[two]),
            hn::ShiftRight<9>(here),
            hn::And(here, twos_of(0xff)),
            ground(two)};
    }

    /// All bits where there is any, else none.
    HWY_INLINE hn::Vec<TwosBits> ground(std::size_t two) const {
        const auto here = hn::And(hn::LoadU(TwosBits(), &how[two]), twos_of(is_ground));
        return hn::Sub(hn::Zero(TwosBits()), hn::ShiftRight<8>(here));
    }
};

/// Adds the pattern to colours of a row of pixels from `first` on: each changes by the pattern
/// times its share of it.
HWY_INLINE void change_row(const GrainRow& grain, std::size_t first, TileBuffer& buffer) {
    const StripSigned sign;
    constexpr auto twice_most = static_cast<std::int16_t>(
        2.0 * 32768.0 * static_cast<double>(scene::GrainPattern::most_share));
    constexpr std::uint16_t white = 255 * 256;
    alignas(64) std::array<std::int16_t, tile_width> each;
    for (std::size_t i = 0; i < twos_a_row; i += twos_at_once) {
        const auto here = hn::LoadU(TwosBits(), &grain.x[i]);
        const auto beside = hn::LoadU(TwosBits(), &grain.x[i + 1]);
        const auto ground = grain.ground(i + 1);
        const auto next = hn::Or(hn::And(beside, ground), hn::AndNot(ground, here));
        const auto low = hn::And(here, twos_of(0xffff));
        const auto high = hn::AndNot(twos_of(0xffff), hn::ShiftLeft<15>(hn::Add(here, next)));
        const hn::Repartition<std::int16_t, TwosBits> halves;
        hn::Store(hn::BitCast(halves, hn::Or(low, high)), halves, &each[2 * i]);
    }
    for (std::size_t i = 0; i < tile_width; i += part_px) {
        const auto share = hn::BitCast(
            sign, hn::ShiftRight<1>(hn::LoadU(Strip(), buffer.sums[3].data() + first + i)));
        const auto seen = hn::ShiftLeft<1>(hn::MulHigh(hn::Load(sign, &each[i]), share));
        const auto twice = hn::ShiftLeft<1>(hn::MulHigh(seen, hn::Set(sign, twice_most)));
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data() + first + i;
            const auto own = hn::LoadU(Strip(), sums);
            const auto half_own = hn::BitCast(sign, hn::ShiftRight<1>(own));
            const auto change = hn::ShiftLeft<1>(hn::MulHigh(half_own, twice));
            const auto more = hn::BitCast(Strip(), hn::Max(change, hn::Zero(sign)));
            const auto less = hn::BitCast(Strip(), hn::Max(hn::Neg(change), hn::Zero(sign)));
            const auto brighter = hn::Min(hn::SaturatedAdd(own, more), hn::Set(Strip(), white));
            hn::StoreU(hn::SaturatedSub(brighter, less), Strip(), sums);
        }
    }
}

constexpr std::size_t parts_a_row = twos_a_row / twos_at_once;

/// Where the pairs of a row of a tile look in the pattern, a bit for each few that have any
/// ground.
HWY_INLINE std::uint32_t
look_at_row(const TileJob& job, const TileBuffer& buffer, int row, GrainRow& grain) {
    const GrainRayPair rays(*job.grain, job.first_px + glm::ivec2(0, row));
    const bool is_last = row + 1 == job.size_px.y;
    const float* const near = buffer.nearness.data() + static_cast<std::size_t>(row) * tile_width;
    const float* const other = is_last && row > 0 ? near - tile_width : near + tile_width;
    std::uint32_t parts = 0;
    for (std::size_t part = 0; part < parts_a_row; ++part) {
        const std::size_t two = part * twos_at_once;
        const Nearness nearness(near + 2 * two, other + 2 * two, is_last);
        if (hn::AllTrue(Twos(), hn::Eq(nearness.here, hn::Zero(Twos())))) {
            hn::StoreU(hn::Zero(TwosBits()), TwosBits(), &grain.how[two]);
            continue;
        }
        parts |= std::uint32_t{1} << part;
        grain.set(two, GrainLook(rays, rays.x.in_row(two), rays.y.in_row(two), nearness).places());
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
    const GrainRayPair rays(*job.grain, job.first_px);
    for (std::size_t row = 0; row < twos_a_row; row += twos_at_once) {
        const Nearness nearness(&here[row], &across[row], &down[row]);
        grain.set(row, GrainLook(rays, rays.x.beside(row), rays.y.beside(row), nearness).places());
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
            const GrainPlaces places = grain.places(two);
            const auto ground = hn::BitCast(TwosWhole(), places.ground);
            seen = hn::And(grain_of(image, places), ground);
        }
        hn::StoreU(hn::BitCast(TwosBits(), seen), TwosBits(), &grain.x[two]);
    }
}

/// Adds the fine pattern to what a tile's pixels have summed up, where its triangles are painted.
/// Each step is done for all rows before the next one: within a step no row waits for another.
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
            grain[row].how[twos_a_row] = beside.how[row];
            change_row(grain[row], row * tile_width, buffer);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
