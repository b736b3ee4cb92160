// Colours the samples of a triangle that nothing nearer covers. Included once for each instruction set.
#if defined(OCTANT_RASTER_FILL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_FILL_INL
#undef OCTANT_RASTER_FILL_INL
#else
#define OCTANT_RASTER_FILL_INL
#endif

#include "visuals/raster/pixel_colour.h"
#include "visuals/raster/tile_coverage-inl.h"
#include "visuals/raster/tile_inverse_depth-inl.h"

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using Pixels = hn::CappedTag<std::uint16_t, 16>;
using PixelsSigned = hn::RebindToSigned<Pixels>;
using Counts = hn::Vec<Pixels>;

constexpr int block_px = 16;

/// Takes the samples of a few pixels that are still free: how many for each, and none at all as `false`. Covers them.
HWY_INLINE bool take_free(const std::uint16_t* masks, std::uint16_t* covered, Counts& counts, std::uint64_t& full) {
    const Pixels px;
    const auto before = hn::LoadU(px, covered);
    const auto fresh = hn::AndNot(before, hn::LoadU(px, masks));
    if (hn::AllTrue(px, hn::Eq(fresh, hn::Zero(px)))) { return false; }
    const auto after = hn::Or(before, fresh);
    hn::StoreU(after, px, covered);
    counts = hn::PopulationCount(fresh);
    alignas(8) std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(px, hn::Eq(after, hn::Set(px, 0xffff)), bits.data());
    full = static_cast<std::uint64_t>(bits[0]) | static_cast<std::uint64_t>(bits[1]) << 8;
    return true;
}

/// Levels along a row of pixels: 1/128 level from the level 128, wrapping.
struct GradientStepper {
    alignas(16) std::array<std::int32_t, 4> base; ///< at the first pixel of a block; 16 bits count
    std::array<std::int16_t, 4> per_px;
};

HWY_INLINE void add_gradient(const GradientStepper& walk, const ColourGradients& gradients, std::size_t k,
    std::size_t pixel_in_block, Counts counts, std::uint16_t* sums) {
    const PixelsSigned sign;
    const Pixels px;
    const auto steps = lane_indices_from(sign, pixel_in_block);
    const auto base = hn::Set(sign, static_cast<std::int16_t>(walk.base[k]));
    const auto raw = hn::Add(base, hn::Mul(steps, hn::Set(sign, walk.per_px[k])));
    const auto level = hn::Min(hn::Max(raw, hn::Set(sign, gradients.least[k])), hn::Set(sign, gradients.most[k]));
    // To 1/16 level from 0, rounded.
    const auto from_zero = hn::Add(hn::BitCast(px, level), hn::Set(px, 128 * 128 + 4));
    const auto colour = hn::ShiftRight<3>(from_zero);
    hn::StoreU(hn::Add(hn::LoadU(px, sums), hn::Mul(colour, counts)), px, sums);
}

/// The planes' levels at a column and row of the picture.
HWY_INLINE void step_gradients(
    const ColourGradients& gradients, std::int32_t column, std::int32_t row, GradientStepper& walk) {
    const hn::FixedTag<std::int32_t, 4> four;
    const auto across = hn::Mul(hn::Load(four, gradients.per_x.data()), hn::Set(four, column));
    const auto down = hn::Mul(hn::Load(four, gradients.per_y.data()), hn::Set(four, row));
    const auto at = hn::Add(hn::Add(hn::Load(four, gradients.base.data()), hn::Set(four, 256)), hn::Add(across, down));
    hn::Store(hn::ShiftRight<9>(at), four, walk.base.data());
    walk.per_px = gradients.per_column;
}

/// Levels corrected for perspective at the ends of a block and even in between. The ends lie within the columns that
/// the triangle covers, where 1 / w is positive.
HWY_INLINE void walk_perspective(
    const TriangleExtra& extra, int column, int last_column, int row, GradientStepper& walk) {
    const int end = std::max(std::min(column + block_px, last_column), column + 1);
    const double w_here = 1.0 / std::max(extra.over_w[4].at(column, row), 1e-30);
    const double w_end = 1.0 / std::max(extra.over_w[4].at(end, row), 1e-30);
    for (std::size_t i = 0; i < walk.base.size(); ++i) {
        const double here = extra.over_w[i].at(column, row) * w_here;
        const double there = extra.over_w[i].at(end, row) * w_end;
        const double per_px = (there - here) / (end - column);
        walk.base[i] = static_cast<std::int32_t>(std::clamp((here - 128.0) * 128.0, -32000.0, 32000.0));
        walk.per_px[i] = static_cast<std::int16_t>(std::clamp(per_px * 128.0, -2000.0, 2000.0));
    }
}

/// The colour of each pixel by itself.
HWY_INLINE void add_pixel_by_pixel(const TileTriangle& one, const TileJob& job, int column, int row,
    const std::uint16_t* counts, std::size_t pixel, TileBuffer& buffer) {
    for (std::size_t i = 0; i < hn::Lanes(Pixels()); ++i) {
        if (counts[i] == 0) { continue; }
        const PixelColour colour = colour_of(one, job, column + static_cast<int>(i), row);
        for (std::size_t k = 0; k < 3; ++k) {
            buffer.sums[k][pixel + i] = static_cast<std::uint16_t>(buffer.sums[k][pixel + i] + colour[k] * counts[i]);
        }
    }
}

/// Adds a triangle's colour where TileBuffer::masks has samples that are free.
HWY_NOINLINE void fill(const TileTriangle& one, const TileJob& job, TileBuffer& buffer) {
    const Coverage& coverage = buffer.coverage;
    const Triangle& triangle = *one.triangle;
    constexpr std::size_t px_at_once = hn::MaxLanes(Pixels());
    for (int at = coverage.first_row; at <= coverage.last_row; ++at) {
        const Coverage::Row places = coverage.rows[static_cast<std::size_t>(at)];
        const int row = job.first_px.y + at;
        if (places.blocks == 0) { continue; }
        for (int block = 0; block < places.blocks; ++block) {
            const int in_tile = places.first + block * block_px;
            const int column = job.first_px.x + in_tile;
            const std::uint16_t* const masks = buffer.masks.data() +
                                               static_cast<std::size_t>(at) * TileBuffer::mask_row +
                                               static_cast<std::size_t>(in_tile);
            const auto pixel = static_cast<std::size_t>(at * tile_width + in_tile);
            bool walked = false;
            GradientStepper walk;
            for (std::size_t i = 0; i < block_px; i += px_at_once) {
                Counts counts;
                std::uint64_t full = 0;
                if (!take_free(masks + i, buffer.covered.data() + pixel + i, counts, full)) { continue; }
                const auto shift = static_cast<std::size_t>(in_tile) + i;
                if (shift < tile_width) { buffer.full[static_cast<std::size_t>(at)] |= full << shift; }
                if (job.detail_texture != nullptr && !triangle.has_detail_texture) {
                    count_other_than_ground(Pixels(), pixel + i, counts, buffer);
                }
                if (triangle.fill != Fill::Gouraud && triangle.fill != Fill::Perspective) {
                    alignas(32) std::array<std::uint16_t, px_at_once> each;
                    hn::Store(counts, Pixels(), each.data());
                    add_pixel_by_pixel(one, job, column + static_cast<int>(i), row, each.data(), pixel + i, buffer);
                    continue;
                }
                if (!walked) {
                    walked = true;
                    if (triangle.fill == Fill::Gouraud) {
                        step_gradients(triangle.gradients, column, row, walk);
                    } else {
                        walk_perspective(*one.extra, column, job.first_px.x + places.last, row, walk);
                    }
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    add_gradient(walk, triangle.gradients, k, i, counts, buffer.sums[k].data() + pixel + i);
                }
                if (triangle.has_detail_texture) {
                    const glm::ivec2 from(in_tile + static_cast<int>(i), at);
                    put_ground(Pixels(), triangle, job, from, counts, buffer);
                }
            }
        }
        if ((buffer.full[static_cast<std::size_t>(at)] & job.full_row()) == job.full_row()) {
            buffer.full_rows |= std::uint32_t{1} << at;
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
