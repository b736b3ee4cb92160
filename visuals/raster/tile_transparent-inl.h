// Veils: triangles that are blended over what lies farther. Walked from near to far, a veil covers nothing; where
// nothing nearer covers it is noted, and blended once what lies behind it is known. Included once for each instruction
// set.
#if defined(OCTANT_RASTER_VEIL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_VEIL_INL
#undef OCTANT_RASTER_VEIL_INL
#else
#define OCTANT_RASTER_VEIL_INL
#endif

#include "visuals/raster/pixel_colour.h"
#include "visuals/raster/tile_coverage-inl.h"

#include <bit>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

HWY_INLINE bool is_transparent_fill(const TileTriangle& one) { return one.triangle->fill == Fill::Transparent; }

/// A plane of levels along a row of pixels, as overlay_colour_of() has it.
struct TransparentColourStep {
    std::int32_t at;
    std::int32_t per_px;
    std::int32_t least;
    std::int32_t most;

    HWY_INLINE TransparentColourStep(const ColourGradients& gradients, std::size_t k, int column, int row)
        : at(static_cast<std::int32_t>(
              static_cast<std::uint32_t>(gradients.base[k]) + 256U +
              static_cast<std::uint32_t>(gradients.per_x[k]) * static_cast<std::uint32_t>(column) +
              static_cast<std::uint32_t>(gradients.per_y[k]) * static_cast<std::uint32_t>(row))),
          per_px(gradients.per_x[k]), least(gradients.least[k]), most(gradients.most[k]) {}

    /// In 1/16 level, so many pixels on.
    HWY_INLINE std::uint32_t sixteenths(int pixels) const {
        const auto here = static_cast<std::int32_t>(
            static_cast<std::uint32_t>(at) + static_cast<std::uint32_t>(per_px) * static_cast<std::uint32_t>(pixels));
        const std::int32_t level = std::clamp(here >> 9, least, most);
        return static_cast<std::uint32_t>(level + 128 * 128 + 4) >> 3;
    }
};

/// Two triangles beside each other in one pixel, as one: no line shows where they meet.
HWY_INLINE void join(const TransparentPixel& neighbour, TransparentPixel& transparent) {
    const std::uint32_t own = transparent.share;
    const std::uint32_t all = own + neighbour.share;
    transparent.mask = static_cast<std::uint16_t>(transparent.mask | neighbour.mask);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t sum = own * transparent.colour[k] + std::uint32_t{neighbour.share} * neighbour.colour[k];
        transparent.colour[k] = static_cast<std::uint16_t>((sum + all / 2) / all);
    }
    transparent.share = static_cast<std::uint16_t>(all);
}

/// Notes where veils that follow each other in the tile's list are seen.
HWY_NOINLINE void record_transparent(
    std::span<const TileTriangle> transparents, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const std::size_t first = buffer.transparent_pixels.size();
    buffer.group_first_transparent.push_back(first);
    buffer.last_transparent.resize(TileBuffer::pixels, 0);
    for (const TileTriangle& one : transparents) {
        cover(one, job, lanes, buffer);
        const Coverage& coverage = buffer.coverage;
        for (int row = coverage.first_row; row <= coverage.last_row; ++row) {
            const Coverage::Row places = coverage.rows[static_cast<std::size_t>(row)];
            const int end = std::min(places.first + places.blocks * 16, job.size_px.x);
            const std::uint16_t* const masks =
                buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row;
            const ColourGradients& gradients = one.triangle->gradients;
            const int first_column = job.first_px.x + places.first;
            const std::array<TransparentColourStep, 4> level{
                TransparentColourStep(gradients, 0, first_column, job.first_px.y + row),
                TransparentColourStep(gradients, 1, first_column, job.first_px.y + row),
                TransparentColourStep(gradients, 2, first_column, job.first_px.y + row),
                TransparentColourStep(gradients, 3, first_column, job.first_px.y + row)};
            for (int column = places.first; column < end; ++column) {
                const auto pixel = static_cast<std::size_t>(row * tile_width + column);
                const auto seen = static_cast<std::uint32_t>(masks[column] & ~buffer.covered[pixel]);
                if (seen == 0) { continue; }
                const int on = column - places.first;
                const auto alpha = (level[3].sixteenths(on) * 4096U + 2040U) / 4080U;
                const std::uint32_t share = alpha * static_cast<std::uint32_t>(std::popcount(seen)) >> 4U;
                if (share == 0) { continue; }
                TransparentPixel transparent;
                transparent.pixel = static_cast<std::uint16_t>(pixel);
                transparent.mask = static_cast<std::uint16_t>(seen);
                transparent.share = static_cast<std::uint16_t>(share);
                for (std::size_t k = 0; k < 3; ++k) {
                    transparent.colour[k] = static_cast<std::uint16_t>(level[k].sixteenths(on));
                }
                std::uint32_t& last = buffer.last_transparent[pixel];
                if (last != 0 && (buffer.transparent_pixels[last - 1].mask & seen) == 0) {
                    join(transparent, buffer.transparent_pixels[last - 1]);
                } else {
                    buffer.transparent_pixels.push_back(transparent);
                    last = static_cast<std::uint32_t>(buffer.transparent_pixels.size());
                }
            }
        }
    }
    for (std::size_t i = first; i < buffer.transparent_pixels.size(); ++i) {
        buffer.last_transparent[buffer.transparent_pixels[i].pixel] = 0;
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
