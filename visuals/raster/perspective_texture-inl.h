// Paints a textured triangle: places in the texture are planes where that is as good (tile_affine), else they are
// corrected for perspective at both ends of sixteen pixels and even in between; and so are light and haze. Included
// once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURE_INL
#undef OCTANT_RASTER_TEXTURE_INL
#else
#define OCTANT_RASTER_TEXTURE_INL
#endif

#include "visuals/raster/affine_span-inl.h"
#include "visuals/raster/strip_walk-inl.h"
#include "visuals/raster/texel_fetch-inl.h"
#include "visuals/raster/tile_fill-inl.h"
#include "visuals/raster/tile_gouraud-inl.h"

#include <bit>
#include <vector>

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

/// What a block's pixels have beside their places.
struct BlockShares {
    alignas(32) std::array<std::uint16_t, block_px> light_left; ///< 2^-16
    alignas(32) std::array<std::uint16_t, block_px> haze;
};

/// A block's colours by the texture's levels: the second one's share is none if it is not there.
struct BlockTexels {
    BlockColours fine;
    BlockColours coarse;
    std::uint16_t coarse_share; ///< 2^-16
};

/// Adds a block's colours to the sums.
HWY_INLINE void add_colours(const BlockTexels& texels, const BlockShares& shares, const TileJob& job,
    const TextureBlock& block, TileBuffer& buffer) {
    const Pixels values;
    const auto coarse_share = hn::Set(values, texels.coarse_share);
    const auto part_of = [&](hn::Vec<Pixels> from, hn::Vec<Pixels> to, hn::Vec<Pixels> weight) HWY_ATTR {
        return hn::Add(hn::Sub(from, hn::MulHigh(from, weight)), hn::MulHigh(to, weight));
    };
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(values)) {
        const auto light_left = hn::LoadU(values, &shares.light_left[i]);
        const auto haze_share = hn::LoadU(values, &shares.haze[i]);
        const auto seen_share = hn::MulHigh(light_left, hn::Not(haze_share));
        const auto count = hn::LoadU(values, block.counts + i);
        for (std::size_t k = 0; k < 3; ++k) {
            auto mine = hn::LoadU(values, &texels.fine.level[k][i]);
            if (texels.coarse_share > 0) {
                mine = part_of(mine, hn::LoadU(values, &texels.coarse.level[k][i]), coarse_share);
            }
            const auto haze_level =
                hn::Set(values, static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F));
            const auto seen = hn::Add(hn::MulHigh(mine, seen_share), hn::MulHigh(haze_level, haze_share));
            const auto colour = hn::ShiftRight<3>(hn::Add(seen, hn::Set(values, 4)));
            std::uint16_t* const sums = buffer.sums[k].data() + block.pixel + i;
            hn::StoreU(hn::Add(hn::LoadU(values, sums), hn::Mul(colour, count)), values, sums);
        }
    }
}

/// Light and haze, even between both ends of a block.
HWY_INLINE BlockShares shares_between(const std::array<TexturePoint, 2>& ends, double share_of_px) {
    const auto sixteen_bits = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto within = hn::Min(hn::Max(end.value[i], real(0.0)), real(1.0));
            return hn::Mul(within, real(65535.0));
        });
    };
    const BlockStepper walk(sixteen_bits(ends[0]), sixteen_bits(ends[1]), share_of_px);
    const Pixels values;
    BlockShares shares;
    const auto along = [&](std::size_t which, std::array<std::uint16_t, block_px>& to) HWY_ATTR {
        for (std::size_t i = 0; i < block_px; i += hn::Lanes(values)) {
            const auto steps = lane_indices_from(values, i);
            const auto at = hn::Add(hn::Set(values, static_cast<std::uint16_t>(walk.first[which])),
                hn::Mul(steps, hn::Set(values, static_cast<std::uint16_t>(walk.per_px[which]))));
            hn::StoreU(at, values, &to[i]);
        }
    };
    along(2, shares.light_left);
    along(3, shares.haze);
    return shares;
}

/// Colours a block, right in perspective at both of its ends.
HWY_INLINE void add_texture(
    const TexturePlanes& planes, const TileJob& job, const TextureBlock& block, TileBuffer& buffer) {
    static constexpr auto one_over = [] {
        std::array<double, block_px + 1> shares{};
        for (int px = 1; px <= block_px; ++px) { shares[static_cast<std::size_t>(px)] = 1.0 / px; }
        return shares;
    }();
    const double by_px = one_over[static_cast<std::size_t>(block.px())];
    const std::array ends{planes.at(block.at.x, block.at.y), planes.at(block.at.x + block.px(), block.at.y)};
    const MipSelection chosen = select_mip_levels(texel_derivatives(planes, ends, by_px), job.ground->levels().size());
    BlockTexels texels;
    texels.coarse_share = chosen.coarse_share;
    sample_texture(*job.ground, chosen.fine, chosen, ends, by_px, texels.fine);
    if (chosen.coarse_share > 0) { sample_texture(*job.ground, chosen.fine + 1, chosen, ends, by_px, texels.coarse); }
    add_colours(texels, shares_between(ends, by_px), job, block, buffer);
}

/// Colours a block of a triangle whose places are planes.
HWY_INLINE void add_affine_texture(
    const AffineSpan& affine, const TileJob& job, const TextureBlock& block, TileBuffer& buffer) {
    BlockTexels texels;
    texels.coarse_share = affine.chosen.coarse_share;
    const std::vector<LitGroundTexture::MipLevel>& levels = job.ground->levels();
    const std::size_t fine = affine.chosen.fine;
    sample_line(levels[fine], affine.line(0, block.at), Probes(affine.chosen, fine), texels.fine);
    if (affine.chosen.coarse_share > 0) {
        sample_line(levels[fine + 1], affine.line(1, block.at), Probes(affine.chosen, fine + 1), texels.coarse);
    }
    BlockShares shares;
    affine.share(0, block.at, shares.light_left);
    affine.share(1, block.at, shares.haze);
    add_colours(texels, shares, job, block, buffer);
}

/// Colours what is new in a row of a strip, each block by add_block().
template <class AddBlock>
HWY_INLINE void add_textured_row(const AddBlock& add_block, const glm::ivec2& at, const StripValues& masks,
    const StripValues& fresh, std::size_t pixel) {
    const std::uint32_t fresh_bits = set_bits(fresh);
    if (fresh_bits == 0) { return; }
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
                at + glm::ivec2(first, 0), at.x + last, counts.data() + first, pixel + static_cast<std::size_t>(first)};
            add_block(block);
        }
    }
}

/// Paints a triangle of Fill::TextureInPerspective that no plane cuts.
HWY_NOINLINE void paint_texture(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(*one.triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) { return; }
    const TexturePlanes planes(*one.extra);
    AffineRows affine_rows(planes, *job.ground, job.first_px, box);
    const auto add = [&](const TextureBlock& block) HWY_ATTR {
        const AffineSpan& affine = affine_rows.of(block.at.y - job.first_px.y);
        if (affine.is_accurate) {
            add_affine_texture(affine, job, block, buffer);
        } else {
            add_texture(planes, job, block, buffer);
        }
    };
    for (int left = box.left; left <= box.right; left += strip_px) {
        const auto paint = [&](int row, const StripValues& masks, const StripValues& fresh) HWY_ATTR {
            const glm::ivec2 at = job.first_px + glm::ivec2(left, row);
            const auto pixel = static_cast<std::size_t>(row * tile_width + left);
            add_textured_row(add, at, masks, fresh, pixel);
        };
        walk_strip<strip_parts>(*one.triangle, job, lanes, box, left, buffer, paint, []() HWY_ATTR {});
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
