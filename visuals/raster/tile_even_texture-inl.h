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

using Texels = hn::Repartition<std::uint32_t, Strip>;
using TexelPlaces = hn::Vec<hn::RebindToSigned<Texels>>; ///< 2^-16 texel
using Colours = MixedColours<Strip>;

/// Places of a register's pixels in the fine level: of those in even lanes, then in odd ones.
struct Places {
    std::array<TexelPlaces, 2> x;
    std::array<TexelPlaces, 2> y;
};

/// One coordinate of places over the picture: 2^-16 texel of the fine level, wrapping.
struct PlacePlane {
    std::uint32_t at; ///< in the tile's first column, at the row at hand
    std::uint32_t per_x;
    std::uint32_t per_row;
    TexelPlaces steps; ///< to even lanes; those of a window's next row begin anew

    HWY_INLINE PlacePlane(const Levels& levels, std::size_t k, const glm::ivec2& first_px)
        : per_x(static_cast<std::uint32_t>(levels.per_x[k]))
        , per_row(static_cast<std::uint32_t>(levels.per_y[k])) {
        constexpr std::uint32_t middle_level = 128U << 16U;
        at = static_cast<std::uint32_t>(levels.base[k]) + middle_level +
             per_x * static_cast<std::uint32_t>(first_px.x) +
             per_row * static_cast<std::uint32_t>(first_px.y);
        const hn::RebindToSigned<Texels> whole;
        const auto pairs = hn::And(counting_from(whole, 0), hn::Set(whole, window_px / 2 - 1));
        steps = hn::Mul(hn::ShiftLeft<1>(pairs), hn::Set(whole, levels.per_x[k]));
    }

    /// From a column on.
    HWY_INLINE std::array<TexelPlaces, 2> places(int column) const {
        const hn::RebindToSigned<Texels> whole;
        return both(hn::Set(whole, of_column(column, 0)));
    }

    /// Of two rows.
    HWY_INLINE std::array<TexelPlaces, 2> places(const PairWindow& window) const {
        const hn::RebindToSigned<Texels> whole;
        const hn::Half<decltype(whole)> row;
        const auto next = hn::Set(row, of_column(window.first[1], per_row));
        return both(hn::Combine(whole, next, hn::Set(row, of_column(window.first[0], 0))));
    }

private:
    std::int32_t of_column(int column, std::uint32_t below) const {
        return static_cast<std::int32_t>(at + per_x * static_cast<std::uint32_t>(column) + below);
    }

    HWY_INLINE std::array<TexelPlaces, 2> both(TexelPlaces first) const {
        const auto even = hn::Add(first, steps);
        const hn::RebindToSigned<Texels> whole;
        return {even, hn::Add(even, hn::Set(whole, static_cast<std::int32_t>(per_x)))};
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

HWY_INLINE Colours colours_at(const GroundImage::Level& level, const Places& places) {
    return mixed_colours<Strip>(level, places.x[0], places.y[0], places.x[1], places.y[1]);
}

/// Places in the next coarser level.
HWY_INLINE Places coarser(const Places& places) {
    const auto of = [](TexelPlaces place) HWY_ATTR {
        const auto quarter = hn::Set(hn::RebindToSigned<Texels>(), 16384); // of a texel
        return hn::Sub(hn::ShiftRight<1>(place), quarter);
    };
    return {{of(places.x[0]), of(places.x[1])}, {of(places.y[0]), of(places.y[1])}};
}

/// What all of a triangle's pixels have in common.
struct TextureLook {
    const GroundImage::Level& fine;
    const GroundImage::Level* coarse; ///< none where the fine one is all
    hn::Vec<Strip> coarse_share;
    Probes probes;
    std::array<std::uint16_t, 3> haze;

    HWY_INLINE TextureLook(const TextureLevels& levels, const TileJob& job)
        : fine(job.ground->levels()[levels.fine])
        , coarse(levels.coarse_share > 0 ? &fine + 1 : nullptr)
        , coarse_share(hn::Set(Strip(), levels.coarse_share))
        , probes(levels, levels.fine) {
        for (std::size_t k = 0; k < haze.size(); ++k) {
            haze[k] = static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F);
        }
    }

    /// The texture's, 1/128 level.
    HWY_INLINE Colours at(const Places& places) const {
        Colours colours = colours_at(fine, places);
        if (coarse != nullptr) {
            const Colours next = colours_at(*coarse, coarser(places));
            for (std::size_t k = 0; k < 3; ++k) {
                colours[k] = part_way(colours[k], next[k], coarse_share);
            }
        }
        return colours;
    }

    static HWY_INLINE Places moved(const Places& places, std::int32_t dx, std::int32_t dy) {
        const hn::RebindToSigned<Texels> whole;
        const auto x = hn::Set(whole, dx);
        const auto y = hn::Set(whole, dy);
        return {
            {hn::Add(places.x[0], x), hn::Add(places.x[1], x)},
            {hn::Add(places.y[0], y), hn::Add(places.y[1], y)}};
    }

    /// 1/16 level.
    HWY_INLINE Colours
    seen(const Places& places, hn::Vec<Strip> light_left, hn::Vec<Strip> haze_share) const {
        Colours colours = probes.mean<Strip>([&](std::int32_t dx, std::int32_t dy)
                                                 HWY_ATTR { return at(moved(places, dx, dy)); });
        const auto seen_share = hn::MulHigh(light_left, hn::Not(haze_share));
        for (std::size_t k = 0; k < 3; ++k) {
            const auto own = hn::MulHigh(colours[k], seen_share);
            const auto of_haze = hn::MulHigh(hn::Set(Strip(), haze[k]), haze_share);
            const auto sum = hn::Add(own, of_haze);
            colours[k] = hn::ShiftRight<3>(hn::Add(sum, hn::Set(Strip(), 4)));
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
        const Colours colours = look.seen(
            {planes[0].places(window), planes[1].places(window)},
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
                const auto first = static_cast<int>(i * part_px);
                const Colours colours = look.seen(
                    {planes[0].places(first), planes[1].places(first)},
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
