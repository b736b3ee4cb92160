// Paints a triangle whose texture lies even on it: places in the texture, light and haze as planes.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_EVEN_TEXTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_EVEN_TEXTURE_INL
#undef OCTANT_RASTER_EVEN_TEXTURE_INL
#else
#define OCTANT_RASTER_EVEN_TEXTURE_INL
#endif

#include "visuals/raster/strip_level-inl.h"
#include "visuals/raster/tile_rows-inl.h"
#include "visuals/raster/tile_texels-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using TexelPlaces = hn::Vec<hn::RebindToSigned<Texels>>; ///< 2^-16 texel

/// Pixels of a register in both its halves: places in the fine level.
struct PlacesOfHalf {
    TexelPlaces x;
    TexelPlaces y;
};

using Places = std::array<PlacesOfHalf, 2>;
using Colours = std::array<hn::Vec<Strip>, 3>; ///< 1/128 level, 32,640 at most

/// One coordinate of places over the picture: 2^-16 texel of the fine level, wrapping.
struct PlacePlane {
    std::uint32_t at; ///< in the tile's first column, at the row at hand
    std::uint32_t per_x;
    std::uint32_t per_row;
    TexelPlaces steps;

    HWY_INLINE PlacePlane(const Levels& levels, std::size_t k, const glm::ivec2& first_px)
        : per_x(static_cast<std::uint32_t>(levels.per_x[k]))
        , per_row(static_cast<std::uint32_t>(levels.per_y[k])) {
        constexpr std::uint32_t middle_level = 128U << 16U;
        at = static_cast<std::uint32_t>(levels.base[k]) + middle_level +
             per_x * static_cast<std::uint32_t>(first_px.x) +
             per_row * static_cast<std::uint32_t>(first_px.y);
        const hn::RebindToSigned<Texels> whole;
        steps = hn::Mul(counting_from(whole, 0), hn::Set(whole, levels.per_x[k]));
    }

    /// From a column on, some rows below the one at hand.
    HWY_INLINE TexelPlaces places(int column, std::uint32_t rows_below) const {
        const std::uint32_t first =
            at + per_x * static_cast<std::uint32_t>(column) + per_row * rows_below;
        return hn::Add(
            hn::Set(hn::RebindToSigned<Texels>(), static_cast<std::int32_t>(first)), steps);
    }
};

/// A share of light or haze, 2^-16, from its level.
HWY_INLINE hn::Vec<Strip> share_of(hn::Vec<StripSigned> level) {
    return hn::ShiftLeft<1>(hn::Add(hn::BitCast(Strip(), level), hn::Set(Strip(), 128 * 128)));
}

/// `how_much`: of the other one, 2^-16.
HWY_INLINE hn::Vec<Strip>
part_way(hn::Vec<Strip> from, hn::Vec<Strip> to, hn::Vec<Strip> how_much) {
    return hn::Add(hn::Sub(from, hn::MulHigh(from, how_much)), hn::MulHigh(to, how_much));
}

/// One level's colours at places, which are kept within its rim.
HWY_INLINE Colours colours_at(const GroundImage::Level& level, const Places& places) {
    const hn::RebindToSigned<Texels> whole;
    const hn::Half<Strip> half;
    const auto within = [&](TexelPlaces place, int size) HWY_ATTR {
        return hn::Min(hn::Max(place, hn::Zero(whole)), hn::Set(whole, (size - 1) * 65536 - 1));
    };
    const TexelSquares low(
        level, within(places[0].x, level.width), within(places[0].y, level.height));
    const TexelSquares high(
        level, within(places[1].x, level.width), within(places[1].y, level.height));
    const auto both = [&](hn::Vec<Texels> lower, hn::Vec<Texels> upper) HWY_ATTR {
        return hn::Combine(
            Strip(),
            hn::DemoteTo(half, hn::BitCast(whole, upper)),
            hn::DemoteTo(half, hn::BitCast(whole, lower)));
    };
    const auto lower_bits = hn::Set(Texels(), 0xffffU);
    const auto low_red_blue = low.mixed<0>();
    const auto high_red_blue = high.mixed<0>();
    return {
        both(hn::And(low_red_blue, lower_bits), hn::And(high_red_blue, lower_bits)),
        both(hn::And(low.mixed<8>(), lower_bits), hn::And(high.mixed<8>(), lower_bits)),
        both(hn::ShiftRight<16>(low_red_blue), hn::ShiftRight<16>(high_red_blue))};
}

/// Places in the next coarser level.
HWY_INLINE Places coarser(const Places& places) {
    const auto of = [](TexelPlaces place) HWY_ATTR {
        const auto quarter = hn::Set(hn::RebindToSigned<Texels>(), 16384); // of a texel
        return hn::Sub(hn::ShiftRight<1>(place), quarter);
    };
    return {
        PlacesOfHalf{of(places[0].x), of(places[0].y)},
        PlacesOfHalf{of(places[1].x), of(places[1].y)}};
}

/// What all of a triangle's pixels have in common.
struct TextureLook {
    const GroundImage::Level& fine;
    const GroundImage::Level* coarse; ///< none where the fine one is all
    hn::Vec<Strip> coarse_share;
    std::array<std::uint16_t, 3> haze;

    HWY_INLINE TextureLook(const TextureLevels& levels, const TileJob& job)
        : fine(job.ground->levels()[levels.fine])
        , coarse(levels.coarse_share > 0 ? &fine + 1 : nullptr)
        , coarse_share(hn::Set(Strip(), levels.coarse_share)) {
        for (std::size_t k = 0; k < haze.size(); ++k) {
            haze[k] = static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F);
        }
    }

    /// 1/16 level.
    HWY_INLINE Colours
    seen(const Places& places, hn::Vec<Strip> light_left, hn::Vec<Strip> haze_share) const {
        Colours colours = colours_at(fine, places);
        if (coarse != nullptr) {
            const Colours next = colours_at(*coarse, coarser(places));
            for (std::size_t k = 0; k < 3; ++k) {
                colours[k] = part_way(colours[k], next[k], coarse_share);
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto lit = hn::MulHigh(colours[k], light_left);
            const auto in_haze = part_way(lit, hn::Set(Strip(), haze[k]), haze_share);
            colours[k] = hn::ShiftRight<3>(hn::Add(in_haze, hn::Set(Strip(), 4)));
        }
        return colours;
    }
};

HWY_INLINE bool has_any(hn::Vec<Strip> values) {
    return !hn::AllTrue(Strip(), hn::Eq(values, hn::Zero(Strip())));
}

HWY_INLINE void paint_texture_in_pairs(
    const Triangle& triangle,
    const TileJob& job,
    const SampleLanes& lanes,
    const TileBox& box,
    TileBuffer& buffer) {
    PairCoverage coverage(triangle, job, box, lanes);
    const TextureLook look(triangle.texture, job);
    const glm::ivec2 first_px = job.first_px + glm::ivec2(0, box.first_row);
    std::array planes{
        PlacePlane(triangle.levels, 0, first_px), PlacePlane(triangle.levels, 1, first_px)};
    std::array shares{
        PairLevel(triangle.levels, 2, job, box), PairLevel(triangle.levels, 3, job, box)};
    const auto paint = [&](const PairWindow& window, hn::Vec<Strip> fresh) HWY_ATTR {
        if (!has_any(fresh)) {
            return;
        }
        const auto of_row = [&](std::size_t row) HWY_ATTR {
            const int first = window.first[row];
            const auto below = static_cast<std::uint32_t>(row);
            return PlacesOfHalf{planes[0].places(first, below), planes[1].places(first, below)};
        };
        const Colours colours = look.seen(
            {of_row(0), of_row(1)},
            share_of(shares[0].level(window)),
            share_of(shares[1].level(window)));
        const auto counts = hn::PopulationCount(fresh);
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data();
            window.store(hn::Add(window.load(sums), hn::Mul(colours[k], counts)), sums);
        }
    };
    paint_in_pairs(coverage, job, box, buffer, paint, [&]() HWY_ATTR {
        for (std::size_t i = 0; i < 2; ++i) {
            planes[i].at += 2 * planes[i].per_row;
            shares[i].next_rows();
        }
    });
}

/// Paints the strip of a triangle that begins at a column of the tile.
HWY_INLINE void paint_texture_strip(
    const Triangle& triangle,
    const TileJob& job,
    const SampleLanes& lanes,
    const TileBox& box,
    int left,
    TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t wide_columns = std::uint64_t{columns} << left;
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    const glm::ivec2 box_px = job.first_px + glm::ivec2(box.left, box.first_row);
    StripCoverage coverage(triangle, first_px, columns, lanes);
    const TextureLook look(triangle.texture, job);
    std::array planes{
        PlacePlane(triangle.levels, 0, first_px), PlacePlane(triangle.levels, 1, first_px)};
    std::array shares{
        StripLevel(triangle.levels, 2, box_px, left - box.left),
        StripLevel(triangle.levels, 3, box_px, left - box.left)};
    auto pixel = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (int row = box.first_row; row <= box.last_row; ++row, pixel += tile_width) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        if ((wide_columns & ~full) != 0) {
            const StripValues masks = coverage.samples();
            StripValues after;
            for (std::size_t i = 0; i < strip_parts; ++i) {
                const std::size_t at = pixel + i * part_px;
                const auto before = hn::LoadU(Strip(), buffer.covered.data() + at);
                const auto fresh = hn::AndNot(before, masks[i]);
                after[i] = hn::Or(before, masks[i]);
                hn::StoreU(after[i], Strip(), buffer.covered.data() + at);
                if (!has_any(fresh)) {
                    continue;
                }
                const auto of_half = [&](std::size_t half) HWY_ATTR {
                    const auto first = static_cast<int>(i * part_px + half * part_px / 2);
                    return PlacesOfHalf{planes[0].places(first, 0), planes[1].places(first, 0)};
                };
                const Colours colours = look.seen(
                    {of_half(0), of_half(1)},
                    share_of(shares[0].level(i)),
                    share_of(shares[1].level(i)));
                const auto counts = hn::PopulationCount(fresh);
                for (std::size_t k = 0; k < 3; ++k) {
                    std::uint16_t* const sums = buffer.sums[k].data() + at;
                    hn::StoreU(
                        hn::Add(hn::LoadU(Strip(), sums), hn::Mul(colours[k], counts)),
                        Strip(),
                        sums);
                }
            }
            full |= std::uint64_t{full_bits(after)} << left;
            buffer.full_rows |= std::uint32_t{(full & job.full_row()) == job.full_row()} << row;
        }
        coverage.next_row();
        for (std::size_t i = 0; i < 2; ++i) {
            planes[i].at += planes[i].per_row;
            shares[i].at += shares[i].per_row;
        }
    }
}

/// Paints a triangle of Fill::Texture.
HWY_NOINLINE void paint_even_texture(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) {
        return;
    }
    if constexpr (has_pairs_of_rows) {
        paint_texture_in_pairs(triangle, job, lanes, box, buffer);
    } else {
        for (int left = box.left; left <= box.right; left += strip_px) {
            paint_texture_strip(triangle, job, lanes, box, left, buffer);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
