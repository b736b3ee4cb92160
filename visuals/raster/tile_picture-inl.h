// From a tile's sums to its pixels in the picture, and what lies over them.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_PICTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_PICTURE_INL
#undef OCTANT_RASTER_PICTURE_INL
#else
#define OCTANT_RASTER_PICTURE_INL
#endif

#include "visuals/raster/pixel_colour.h"
#include "visuals/raster/tile_coverage-inl.h"
#include "visuals/raster/tile_fill-inl.h"

#include <cstring>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

HWY_NOINLINE void clear(TileBuffer& buffer) {
    buffer.covered.fill(0);
    for (auto& plane : buffer.sums) {
        plane.fill(0);
    }
    buffer.full.fill(0);
    buffer.full_rows = 0;
}

/// One row of sixteen pixels: what is left free has the background.
HWY_INLINE void
resolve_block(const TileJob& job, const TileBuffer& buffer, std::size_t pixel, std::uint8_t* rgba) {
    const Pixels px;
    const hn::Rebind<std::uint8_t, Pixels> bytes;
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(px)) {
        const auto covered = hn::LoadU(px, buffer.covered.data() + pixel + i);
        const auto free = hn::Sub(hn::Set(px, 16), hn::PopulationCount(covered));
        const auto level = [&](std::size_t k) HWY_ATTR {
            const auto background =
                hn::Mul(free, hn::Set(px, static_cast<std::uint16_t>(job.background[k] * 16)));
            const auto sum = hn::Add(hn::LoadU(px, buffer.sums[k].data() + pixel + i), background);
            const auto rounded = hn::ShiftRight<8>(hn::Add(sum, hn::Set(px, 128)));
            return hn::DemoteTo(bytes, hn::BitCast(PixelsSigned(), rounded));
        };
        hn::StoreInterleaved4(
            level(0), level(1), level(2), hn::Set(bytes, 255), bytes, rgba + 4 * i);
    }
}

HWY_NOINLINE void resolve(const TileJob& job, TileBuffer& buffer) {
    alignas(64) std::array<std::uint8_t, std::size_t{4} * tile_width> line;
    for (int row = 0; row < job.size_px.y; ++row) {
        std::uint8_t* const to = job.rgba + static_cast<std::size_t>(row) * job.row_bytes;
        const bool whole = job.size_px.x == tile_width;
        std::uint8_t* const into = whole ? to : line.data();
        for (std::size_t column = 0; column < tile_width; column += block_px) {
            resolve_block(
                job,
                buffer,
                static_cast<std::size_t>(row) * tile_width + column,
                into + 4 * column);
        }
        if (!whole) {
            std::memcpy(to, line.data(), static_cast<std::size_t>(job.size_px.x) * 4);
        }
    }
}

/// Blends what waits at a pixel.
HWY_INLINE void blend(const TileJob& job, int column, int row, TileBuffer& buffer) {
    const auto pixel = static_cast<std::size_t>(row * tile_width + column);
    const std::uint32_t colour = buffer.waiting_colour[pixel];
    const auto samples_covered = static_cast<std::uint32_t>(std::popcount(buffer.waiting[pixel]));
    const std::uint32_t share = (colour >> 24U) * samples_covered; // of 255 * 16
    std::uint8_t* const to = job.rgba + static_cast<std::size_t>(row) * job.row_bytes +
                             static_cast<std::size_t>(column) * 4;
    for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t over = colour >> (8 * k) & 0xffU;
        to[k] = static_cast<std::uint8_t>((over * share + to[k] * (4080U - share) + 2040U) / 4080U);
    }
    buffer.waiting[pixel] = 0;
}

/// Triangles over the picture, blended by their alpha. Neighbours of one colour that share a pixel
/// are blended as one, so that no line shows between them.
HWY_INLINE void paint_overlay(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    if (job.overlay.empty()) {
        return;
    }
    buffer.full.fill(0);
    buffer.full_rows = 0;
    buffer.waiting.assign(TileBuffer::pixels, 0);
    buffer.waiting_colour.resize(TileBuffer::pixels);
    for (const TileTriangle& one : job.overlay) {
        cover(one, job, lanes, buffer);
        const Coverage& coverage = buffer.coverage;
        for (int row = coverage.first_row; row <= coverage.last_row; ++row) {
            const Coverage::Row places = coverage.rows[static_cast<std::size_t>(row)];
            const int end = std::min(places.first + places.blocks * block_px, job.size_px.x);
            const std::uint16_t* const masks =
                buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row;
            for (int column = places.first; column < end; ++column) {
                const std::uint16_t mask = masks[column];
                if (mask == 0) {
                    continue;
                }
                const auto pixel = static_cast<std::size_t>(row * tile_width + column);
                const std::uint32_t colour =
                    overlay_colour_of(one, job.first_px.x + column, job.first_px.y + row);
                if (buffer.waiting[pixel] != 0 && (buffer.waiting_colour[pixel] != colour ||
                                                   (buffer.waiting[pixel] & mask) != 0)) {
                    blend(job, column, row, buffer);
                }
                buffer.waiting[pixel] = static_cast<std::uint16_t>(buffer.waiting[pixel] | mask);
                buffer.waiting_colour[pixel] = colour;
            }
        }
    }
    for (int row = 0; row < job.size_px.y; ++row) {
        for (int column = 0; column < job.size_px.x; ++column) {
            if (buffer.waiting[static_cast<std::size_t>(row * tile_width + column)] != 0) {
                blend(job, column, row, buffer);
            }
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
