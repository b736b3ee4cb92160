// Paints a textured triangle: places in the texture are corrected for perspective
// at both ends of sixteen pixels and even in between, and so are light and haze.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURE_INL
#undef OCTANT_RASTER_TEXTURE_INL
#else
#define OCTANT_RASTER_TEXTURE_INL
#endif

#include "visuals/raster/tile_fill-inl.h"
#include "visuals/raster/tile_levels-inl.h"
#include "visuals/raster/tile_texels-inl.h"

#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// Pixels of a strip whose value is not zero, a bit each.
HWY_INLINE std::uint32_t set_bits(const StripValues& values) {
    StripValues is_set;
    for (std::size_t i = 0; i < strip_parts; ++i) {
        is_set[i] = hn::VecFromMask(Strip(), hn::Ne(values[i], hn::Zero(Strip())));
    }
    return full_bits(is_set);
}

/// Pixels of a strip that are coloured from one place on.
struct TextureBlock {
    glm::ivec2 at;               ///< column and row of the picture
    int last_column;             ///< of the strip's pixels that the triangle covers
    const std::uint16_t* counts; ///< of new samples of each of its sixteen pixels
    std::size_t pixel;           ///< of the tile

    int px() const { return std::clamp(last_column - at.x, 1, block_px); }
};

/// Colours a block.
HWY_INLINE void add_texture(
    const TexturePlanes& planes,
    const TileJob& job,
    const TextureBlock& block,
    TileBuffer& buffer) {
    static constexpr auto one_over = [] {
        std::array<double, block_px + 1> shares{};
        for (int px = 1; px <= block_px; ++px) {
            shares[static_cast<std::size_t>(px)] = 1.0 / px;
        }
        return shares;
    }();
    const double by_px = one_over[static_cast<std::size_t>(block.px())];
    const std::array ends{
        planes.at(block.at.x, block.at.y), planes.at(block.at.x + block.px(), block.at.y)};
    const TextureLevels chosen =
        levels_of(footprint2(planes, ends, by_px), job.ground->levels().size());
    BlockColours own;
    BlockColours coarse;
    sample_texture(*job.ground, chosen.fine, ends, by_px, own);
    if (chosen.coarse_share > 0) {
        sample_texture(*job.ground, chosen.fine + 1, ends, by_px, coarse);
    }
    const Pixels values;
    const auto shares = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto within = hn::Min(hn::Max(end.value[i], real(0.0)), real(1.0));
            return hn::Mul(within, real(65535.0));
        });
    };
    const BlockWalk share(shares(ends[0]), shares(ends[1]), by_px);
    const auto along = [&](std::size_t which, std::size_t i) HWY_ATTR {
        const auto steps = hn::Iota(values, static_cast<std::uint16_t>(i));
        return hn::Add(
            hn::Set(values, static_cast<std::uint16_t>(share.first[which])),
            hn::Mul(steps, hn::Set(values, static_cast<std::uint16_t>(share.per_px[which]))));
    };
    const auto coarse_share = hn::Set(values, chosen.coarse_share);
    const auto part_of =
        [&](hn::Vec<Pixels> from, hn::Vec<Pixels> to, hn::Vec<Pixels> how_much) HWY_ATTR {
            return hn::Add(hn::Sub(from, hn::MulHigh(from, how_much)), hn::MulHigh(to, how_much));
        };
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(values)) {
        const auto light_left = along(2, i);
        const auto haze_share = along(3, i);
        const auto count = hn::LoadU(values, block.counts + i);
        for (std::size_t k = 0; k < 3; ++k) {
            auto mine = hn::LoadU(values, &own.level[k][i]);
            if (chosen.coarse_share > 0) {
                mine = part_of(mine, hn::LoadU(values, &coarse.level[k][i]), coarse_share);
            }
            const auto haze_level = hn::Set(
                values,
                static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F));
            const auto seen = part_of(hn::MulHigh(mine, light_left), haze_level, haze_share);
            const auto colour = hn::ShiftRight<3>(hn::Add(seen, hn::Set(values, 4)));
            std::uint16_t* const sums = buffer.sums[k].data() + block.pixel + i;
            hn::StoreU(hn::Add(hn::LoadU(values, sums), hn::Mul(colour, count)), values, sums);
        }
    }
}

/// Colours what is new in a row of a strip.
HWY_INLINE void add_textured_row(
    const TexturePlanes& planes,
    const TileJob& job,
    const glm::ivec2& at,
    const StripValues& masks,
    const StripValues& fresh,
    std::size_t pixel,
    TileBuffer& buffer) {
    const std::uint32_t fresh_bits = set_bits(fresh);
    if (fresh_bits == 0) {
        return;
    }
    alignas(64) std::array<std::uint16_t, strip_px + block_px> counts;
    for (std::size_t i = 0; i < strip_parts; ++i) {
        hn::Store(hn::PopulationCount(fresh[i]), Strip(), counts.data() + i * part_px);
    }
    std::fill(counts.begin() + strip_px, counts.end(), std::uint16_t{0});
    const std::uint32_t covered_bits = set_bits(masks);
    const int last = 31 - std::countl_zero(covered_bits);
    for (int first = std::countr_zero(covered_bits); first <= last; first += block_px) {
        const std::uint32_t in_block = fresh_bits >> first & 0xffffU;
        if (in_block != 0) {
            const TextureBlock block{
                at + glm::ivec2(first, 0),
                at.x + last,
                counts.data() + first,
                pixel + static_cast<std::size_t>(first)};
            add_texture(planes, job, block, buffer);
        }
    }
}

/// Paints the strip of a textured triangle that begins at a column of the tile.
HWY_INLINE void paint_textured_strip(
    const TileTriangle& one,
    const TileJob& job,
    const SampleLanes& lanes,
    const TileBox& box,
    int left,
    TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t wide_columns = std::uint64_t{columns} << left;
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    StripCoverage coverage(*one.triangle, first_px, columns, lanes);
    const TexturePlanes planes(*one.extra);
    for (int row = box.first_row; row <= box.last_row; ++row) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        if ((wide_columns & ~full) != 0) {
            const auto pixel = static_cast<std::size_t>(row * tile_width + left);
            const StripValues masks = coverage.samples();
            StripValues fresh;
            StripValues after;
            for (std::size_t i = 0; i < strip_parts; ++i) {
                std::uint16_t* const covered = buffer.covered.data() + pixel + i * part_px;
                const auto before = hn::LoadU(Strip(), covered);
                fresh[i] = hn::AndNot(before, masks[i]);
                after[i] = hn::Or(before, masks[i]);
                hn::StoreU(after[i], Strip(), covered);
            }
            full |= std::uint64_t{full_bits(after)} << left;
            buffer.full_rows |= std::uint32_t{(full & job.full_row()) == job.full_row()} << row;
            const glm::ivec2 at = job.first_px + glm::ivec2(left, row);
            add_textured_row(planes, job, at, masks, fresh, pixel, buffer);
        }
        coverage.next_row();
    }
}

/// Paints a triangle of Fill::Texture that no plane cuts.
HWY_NOINLINE void paint_texture(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(*one.triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) {
        return;
    }
    for (int left = box.left; left <= box.right; left += strip_px) {
        paint_textured_strip(one, job, lanes, box, left, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
