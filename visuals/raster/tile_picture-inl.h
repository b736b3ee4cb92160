// From a tile's sums to its pixels in the picture, and what lies over them. Included once for each instruction set.
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
#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

HWY_NOINLINE void clear(const TileJob& job, TileBuffer& buffer) {
    buffer.covered.fill(0);
    for (std::size_t k = 0; k < 3; ++k) { buffer.sums[k].fill(0); }
    if (job.detail_texture != nullptr) {
        buffer.sums[3].fill(0);
        buffer.ground.fill(0);
    }
    buffer.full.fill(0);
    buffer.full_rows = 0;
}

/// Where red, green or blue lies in a pixel.
HWY_INLINE std::size_t byte_of_colour(const TileJob& job, std::size_t colour) {
    return job.blue_first ? 2 - colour : colour;
}

using Words = hn::CappedTag<std::uint32_t, 16>;
using HalfWords = hn::Rebind<std::uint16_t, Words>;

/// A colour of a tile: its sums, and what free samples add to them.
struct ColourPlane {
    const std::uint16_t* sums;
    std::uint16_t background;
};

/// A tile's colours in the order of a pixel's bytes.
using ColourPlanes = std::array<ColourPlane, 3>;

/// Pixels from their sums; what is left free has the background.
template <bool has_free>
HWY_INLINE hn::Vec<Words> pixels_of(const ColourPlanes& planes, const TileBuffer& buffer, std::size_t first) {
    const Words words;
    const HalfWords halves;
    const auto half_level = hn::Set(halves, 128);
    const auto rounded = [&](std::size_t k) HWY_ATTR {
        const auto sum = hn::Add(hn::LoadU(halves, planes[k].sums + first), half_level);
        if constexpr (has_free) {
            const auto covered = hn::LoadU(halves, buffer.covered.data() + first);
            const auto free = hn::Sub(hn::Set(halves, 16), hn::PopulationCount(covered));
            return hn::Add(sum, hn::Mul(free, hn::Set(halves, planes[k].background)));
        } else {
            return sum;
        }
    };
    const auto high_byte = hn::Set(halves, 0xff00);
    const auto first_two = hn::Or(hn::ShiftRight<8>(rounded(0)), hn::And(rounded(1), high_byte));
    const auto last_two = hn::Or(hn::ShiftRight<8>(rounded(2)), high_byte);
    return hn::Or(hn::PromoteTo(words, first_two), hn::ShiftLeft<16>(hn::PromoteTo(words, last_two)));
}

using Line = std::array<std::uint32_t, tile_width>;

template <bool has_free>
HWY_INLINE void resolve_row(const ColourPlanes& planes, const TileBuffer& buffer, std::size_t first, Line& line) {
    for (std::size_t column = 0; column < tile_width; column += hn::Lanes(Words())) {
        const auto pixels = pixels_of<has_free>(planes, buffer, first + column);
        hn::Store(pixels, Words(), line.data() + column);
    }
}

/// Writes a whole line past the caches: the picture is too large for them, and the next tile wants them. Parts of the
/// caches' lines would be read from memory first.
HWY_INLINE void stream(const Line& line, std::uint8_t* to) {
    const Words words;
    for (std::size_t i = 0; i < tile_width; i += hn::Lanes(words)) {
        const auto pixels = hn::Load(words, line.data() + i);
        hn::Stream(pixels, words, reinterpret_cast<std::uint32_t*>(to) + i);
    }
}

HWY_NOINLINE void resolve(const TileJob& job, TileBuffer& buffer) {
    alignas(64) Line line;
    ColourPlanes planes;
    for (std::size_t k = 0; k < 3; ++k) {
        planes[byte_of_colour(job, k)] = {buffer.sums[k].data(), static_cast<std::uint16_t>(job.background[k] * 16)};
    }
    constexpr std::uintptr_t alignment = 64; // a line of the caches
    const bool may_stream = job.size_px.x == tile_width && job.row_bytes % alignment == 0 &&
                            reinterpret_cast<std::uintptr_t>(job.rgba) % alignment == 0;
    for (int row = 0; row < job.size_px.y; ++row) {
        std::uint8_t* const to = job.rgba + static_cast<std::size_t>(row) * job.row_bytes;
        const auto first = static_cast<std::size_t>(row) * tile_width;
        if ((buffer.full_rows >> row & 1U) != 0) {
            resolve_row<false>(planes, buffer, first, line);
        } else {
            resolve_row<true>(planes, buffer, first, line);
        }
        if (may_stream) {
            stream(line, to);
        } else {
            std::memcpy(to, line.data(), static_cast<std::size_t>(job.size_px.x) * 4);
        }
    }
    hwy::FlushStream();
}

/// Blends what waits at a pixel.
HWY_INLINE void blend(const TileJob& job, int column, int row, TileBuffer& buffer) {
    const auto pixel = static_cast<std::size_t>(row * tile_width + column);
    const std::uint32_t colour = buffer.pending_colours[pixel];
    const auto samples_covered = static_cast<std::uint32_t>(std::popcount(buffer.pending[pixel]));
    const std::uint32_t share = (colour >> 24U) * samples_covered; // of 255 * 16
    std::uint8_t* const to =
        job.rgba + static_cast<std::size_t>(row) * job.row_bytes + static_cast<std::size_t>(column) * 4;
    for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t over = colour >> (8 * k) & 0xffU;
        std::uint8_t& under = to[byte_of_colour(job, k)];
        under = static_cast<std::uint8_t>((over * share + under * (4080U - share) + 2040U) / 4080U);
    }
    buffer.pending[pixel] = 0;
}

/// Blends one clear triangle over a pixel.
HWY_INLINE void blend_transparent_pixel(const TileJob& job, const TransparentPixel& clear) {
    constexpr std::uint32_t whole = TransparentPixel::whole;
    const std::uint32_t share = clear.share;
    const int row = clear.pixel / tile_width;
    const int column = clear.pixel % tile_width;
    std::uint8_t* const to =
        job.rgba + static_cast<std::size_t>(row) * job.row_bytes + static_cast<std::size_t>(column) * 4;
    for (std::size_t k = 0; k < 3; ++k) {
        std::uint8_t& under = to[byte_of_colour(job, k)];
        const std::uint32_t there = under * std::uint32_t{16};
        const std::uint32_t mixed = clear.colour[k] * share + there * (whole - share);
        under = static_cast<std::uint8_t>((mixed + 8 * whole) / (16 * whole));
    }
}

/// Clear surfaces over the picture: the farthest group's first.
HWY_INLINE void blend_transparent(const TileJob& job, const TileBuffer& buffer) {
    std::size_t end = buffer.transparent_pixels.size();
    for (std::size_t group = buffer.group_first_transparent.size(); group > 0; --group) {
        const std::size_t first = buffer.group_first_transparent[group - 1];
        for (std::size_t i = first; i < end; ++i) { blend_transparent_pixel(job, buffer.transparent_pixels[i]); }
        end = first;
    }
}

/// Triangles over the picture, blended by their alpha. Neighbours of one colour that share a pixel are blended as one,
/// so that no line shows between them.
HWY_INLINE void paint_overlay(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    if (job.overlay.empty()) { return; }
    buffer.full.fill(0);
    buffer.full_rows = 0;
    buffer.pending.assign(TileBuffer::pixels, 0);
    buffer.pending_colours.resize(TileBuffer::pixels);
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
                if (mask == 0) { continue; }
                const auto pixel = static_cast<std::size_t>(row * tile_width + column);
                const std::uint32_t colour = overlay_colour_of(one, job.first_px.x + column, job.first_px.y + row);
                if (buffer.pending[pixel] != 0 &&
                    (buffer.pending_colours[pixel] != colour || (buffer.pending[pixel] & mask) != 0)) {
                    blend(job, column, row, buffer);
                }
                buffer.pending[pixel] = static_cast<std::uint16_t>(buffer.pending[pixel] | mask);
                buffer.pending_colours[pixel] = colour;
            }
        }
    }
    for (int row = 0; row < job.size_px.y; ++row) {
        for (int column = 0; column < job.size_px.x; ++column) {
            if (buffer.pending[static_cast<std::size_t>(row * tile_width + column)] != 0) {
                blend(job, column, row, buffer);
            }
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
