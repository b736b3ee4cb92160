// Step 5 of a picture (renderer.cpp): paints one tile; PaintTile() at the end has the order of the work. Compiled once
// for each instruction set; all give the same bits, because colours and crossings are whole numbers, and real numbers
// are added and multiplied one by one.
//
// Step 6 is in the files that this one includes, each before those that use it:
//   strip_coverage-inl.h        coverage masks and gradients of strips, 32 pixels of a row
//   gouraud_triangle-inl.h      triangles with linear colours: nearly all of a picture
//   any_triangle-inl.h          triangles of any other fill: coverage, colour, depth groups, transparent triangles
//   textured_triangle-inl.h     triangles of textured ground: texels, filter, planes, spans
//   textured_mesh-inl.h         triangles of meshes that have textures, pixel by pixel
//   detail_texture-inl.h        the detail texture of near ground, after all triangles of the tile
//   reference_rasterizer-inl.h  painter's algorithm and depth buffer with one sample a pixel, for comparison
#include "visuals/raster/tile.h"

// SVE's vectors have no size that the compiler knows: they can be no members.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_WANT_AVX3_DL
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visuals/raster/tile_painter.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

// Lanes that g++ makes of single numbers, for processors without SSE4 and for tests: optimised in full they take more
// compiling than all other sets together.
#if HWY_TARGET == HWY_EMU128 && HWY_COMPILER_GCC_ACTUAL
#pragma GCC optimize("Og")
#endif

#include "visuals/raster/any_triangle-inl.h"
#include "visuals/raster/detail_texture-inl.h"
#include "visuals/raster/gouraud_triangle-inl.h"
#include "visuals/raster/pixel_colour.h"
#include "visuals/raster/reference_rasterizer-inl.h"
#include "visuals/raster/strip_coverage-inl.h"
#include "visuals/raster/textured_mesh-inl.h"
#include "visuals/raster/textured_triangle-inl.h"
#include "visuals/raster/truth_middles.h"
#include "visuals/raster/truth_surfaces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <hwy/highway.h>
#include <hwy/targets.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_NOINLINE void reset(const TileJob& job, TileBuffer& buffer) {
    buffer.covered.fill(0);
    for (std::size_t k = 0; k < 3; ++k) { buffer.sums[k].fill(0); }
    if (job.detail_texture != nullptr) {
        buffer.sums[3].fill(0);
        buffer.ground.fill(0);
    }
    buffer.full.fill(0);
    buffer.full_rows = 0;
    for (const TransparentPixel& transparent : buffer.transparent_pixels) { // of the tile before
        buffer.only_transparent[transparent.pixel] = 0;
    }
    buffer.transparent_pixels.clear();
    buffer.group_first_transparent.clear();
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

/// Full values of sums of sixteen samples and of 16 bits.
constexpr std::uint32_t full_sum = 255 * 256;
constexpr std::uint32_t full_deep = 65535;

/// A pixel with 16 bits.
HWY_INLINE std::uint16_t* deep_pixel(const TileJob& job, int column, int row) {
    return job.deep + static_cast<std::size_t>(row) * job.row_deep + static_cast<std::size_t>(column) * 3;
}

/// resolve() with 16 bits: all that the sums hold.
HWY_NOINLINE void resolve_deep(const TileJob& job, const TileBuffer& buffer) {
    for (int row = 0; row < job.size_px.y; ++row) {
        for (int column = 0; column < job.size_px.x; ++column) {
            const auto pixel = static_cast<std::size_t>(row * tile_width + column);
            const bool is_full = (buffer.full_rows >> row & 1U) != 0;
            const auto free = is_full ? 0U : 16U - static_cast<std::uint32_t>(std::popcount(buffer.covered[pixel]));
            std::uint16_t* const to = deep_pixel(job, column, row);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t sum = buffer.sums[k][pixel] + free * job.background[k] * 16U;
                to[k] = static_cast<std::uint16_t>((sum * full_deep + full_sum / 2) / full_sum);
            }
        }
    }
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
        if (job.deep != nullptr) {
            std::uint16_t& deep = deep_pixel(job, column, row)[k];
            deep = static_cast<std::uint16_t>((over * 257U * share + deep * (4080U - share) + 2040U) / 4080U);
        }
    }
    buffer.pending[pixel] = 0;
}

/// Blends one transparent triangle over a pixel.
HWY_INLINE void blend_transparent_pixel(const TileJob& job, const TransparentPixel& transparent) {
    constexpr std::uint32_t whole = TransparentPixel::whole;
    const std::uint32_t share = transparent.share;
    const int row = transparent.pixel / tile_width;
    const int column = transparent.pixel % tile_width;
    std::uint8_t* const to =
        job.rgba + static_cast<std::size_t>(row) * job.row_bytes + static_cast<std::size_t>(column) * 4;
    for (std::size_t k = 0; k < 3; ++k) {
        std::uint8_t& under = to[byte_of_colour(job, k)];
        const std::uint32_t there = under * std::uint32_t{16};
        const std::uint32_t mixed = transparent.colour[k] * share + there * (whole - share);
        under = static_cast<std::uint8_t>((mixed + 8 * whole) / (16 * whole));
        if (job.deep != nullptr) {
            std::uint16_t& deep = deep_pixel(job, column, row)[k];
            const std::uint32_t colour = (transparent.colour[k] * 257U + 8U) / 16U;
            deep = static_cast<std::uint16_t>((colour * share + deep * (whole - share) + whole / 2) / whole);
        }
    }
}

/// Blends transparent surfaces over the picture, the farthest group first.
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
        for_each_covered(job, buffer, [&](const glm::ivec2& at, std::size_t pixel, std::uint16_t mask) HWY_ATTR {
            const std::uint32_t colour = overlay_colour_of(one, job.first_px.x + at.x, job.first_px.y + at.y);
            if (buffer.pending[pixel] != 0 &&
                (buffer.pending_colours[pixel] != colour || (buffer.pending[pixel] & mask) != 0)) {
                blend(job, at.x, at.y, buffer);
            }
            buffer.pending[pixel] = static_cast<std::uint16_t>(buffer.pending[pixel] | mask);
            buffer.pending_colours[pixel] = colour;
        });
    }
    for (int row = 0; row < job.size_px.y; ++row) {
        for (int column = 0; column < job.size_px.x; ++column) {
            if (buffer.pending[static_cast<std::size_t>(row * tile_width + column)] != 0) {
                blend(job, column, row, buffer);
            }
        }
    }
}

/// Paints a triangle that has no depth.
HWY_INLINE void paint_one(const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const Fill fill_with = one.triangle->fill;
    const bool is_cut = one.extra != nullptr && one.extra->cut_count > 0;
    if (one.surface != nullptr && !is_cut && !one.surface->texture->has_holes) {
        paint_textured_mesh(one, job, lanes, buffer);
        return;
    }
    if (one.surface == nullptr && fill_with == Fill::Gouraud && one.extra == nullptr) {
        if (job.detail_texture == nullptr) {
            paint_gouraud<PaintAs::Plain>(*one.triangle, job, lanes, buffer);
        } else if (one.triangle->has_detail_texture) {
            paint_gouraud<PaintAs::Ground>(*one.triangle, job, lanes, buffer);
        } else {
            paint_gouraud<PaintAs::OtherThanGround>(*one.triangle, job, lanes, buffer);
        }
    } else if (fill_with == Fill::Texture || (fill_with == Fill::TextureInPerspective && one.extra->cut_count == 0)) {
        paint_texture(one, job, lanes, buffer);
    } else {
        cover(one, job, lanes, buffer);
        fill(one, job, buffer);
    }
}

HWY_INLINE void paint_near_to_far(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    std::size_t end = job.triangles.size();
    while (end > 0 && buffer.full_rows != job.full_rows()) {
        if (end >= triangles_ahead) { prefetch_triangle(job.triangles, end - triangles_ahead); }
        const std::uint16_t group = job.triangles[end - 1].triangle->group;
        std::size_t first = end - 1;
        if (is_blended_in_order(job.triangles[first])) {
            while (first > 0 && is_blended_in_order(job.triangles[first - 1])) { --first; }
            record_transparent({job.triangles.data() + first, end - first}, job, lanes, buffer);
        } else if (group == 0) {
            const TileTriangle& one = job.triangles[first];
            paint_one(one, job, lanes, buffer);
        } else {
            while (first > 0 && job.triangles[first - 1].triangle->group == group) { --first; }
            paint_group(job, {first, end}, lanes, buffer);
        }
        end = first;
    }
}

/// The place of a triangle's key in SampleOwners::keys. Looked up when samples of it are seen: most triangles are
/// hidden.
class SampleOwner {
public:
    SampleOwner(const SampleOwners& owners, const Triangle& triangle) : owners_(owners), source_(triangle.source) {}

    /// Beyond the list for what no pixel belongs to.
    std::uint16_t place() {
        if (place_ == unknown) {
            const auto found = std::ranges::find(owners_.keys, owners_.surfaces->key(source_));
            place_ = static_cast<std::uint16_t>(found - owners_.keys.begin());
        }
        return place_;
    }

private:
    static constexpr std::uint16_t unknown = 0xffff; // a tile has fewer keys

    const SampleOwners& owners_;
    std::uint32_t source_;
    std::uint16_t place_ = unknown;
};

/// Takes the samples that TileBuffer::masks has of a triangle and that are still free, and counts them where the pixel
/// belongs to what the triangle does.
template <class IsShown>
HWY_INLINE void count_covered(const TileJob& job, const SampleOwners& owners, const Triangle& triangle,
    TileBuffer& buffer, const IsShown& is_shown) {
    SampleOwner owner(owners, triangle);
    for_each_covered(job, buffer, [&](const glm::ivec2& at, std::size_t pixel, std::uint16_t mask) HWY_ATTR {
        const auto fresh = static_cast<std::uint16_t>(mask & ~buffer.covered[pixel]);
        if (fresh == 0 || !is_shown(at)) { return; }
        buffer.covered[pixel] = static_cast<std::uint16_t>(buffer.covered[pixel] | fresh);
        if (owners.of_pixels[pixel] == owner.place()) {
            buffer.sums[0][pixel] = static_cast<std::uint16_t>(buffer.sums[0][pixel] + std::popcount(fresh));
        }
        if (buffer.covered[pixel] == 0xffff) {
            std::uint64_t& full = buffer.full[static_cast<std::size_t>(at.y)];
            full |= std::uint64_t{1} << at.x;
            buffer.full_rows |= std::uint32_t{(full & job.full_row()) == job.full_row()} << at.y;
        }
    });
}

/// The same of a triangle that has no depth and that no clip plane cuts, strip by strip.
HWY_NOINLINE void count_uncut(const Triangle& triangle, const TileJob& job, const SampleLanes& lanes,
    const SampleOwners& owners, TileBuffer& buffer) {
    const TileBox box(triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) { return; }
    SampleOwner owner(owners, triangle);
    for (int left = box.left; left <= box.right; left += strip_px) {
        with_parts_of_strip(box, left, [&](auto parts) HWY_ATTR {
            const auto count = [&](int row, const auto& fresh) HWY_ATTR {
                auto at = static_cast<std::size_t>(row * tile_width + left);
                for (std::size_t i = 0; i < fresh.size(); ++i, at += part_px) {
                    if (hn::AllTrue(Strip(), hn::Eq(fresh[i], hn::Zero(Strip())))) { continue; }
                    const auto is_own =
                        hn::Eq(hn::LoadU(Strip(), owners.of_pixels.data() + at), hn::Set(Strip(), owner.place()));
                    std::uint16_t* const sums = buffer.sums[0].data() + at;
                    const auto counts = hn::IfThenElseZero(is_own, hn::PopulationCount(fresh[i]));
                    hn::StoreU(hn::Add(hn::LoadU(Strip(), sums), counts), Strip(), sums);
                }
            };
            walk_strip<decltype(parts)::value>(triangle, job, lanes, box, left, buffer, count, [] {});
        });
    }
}

/// Triangles `first` to `end` - 1 are a group that is drawn by depth, glass too.
HWY_INLINE void count_group(const TileJob& job, const std::array<std::size_t, 2>& range, const SampleLanes& lanes,
    const SampleOwners& owners, TileBuffer& buffer) {
    const auto group = job.triangles.subspan(range[0], range[1] - range[0]);
    const GroupBox box = box_of(group, job);
    if (box.left > box.right || box.first_row > box.last_row) { return; }
    clear_group(box, buffer);
    for (std::size_t i = 0; i < group.size(); ++i) {
        if (group[i].triangle->is_under_side || is_transparent_fill(group[i])) { continue; }
        cover(group[i], job, lanes, buffer);
        draw_by_depth(group[i], static_cast<std::uint32_t>(i + 1), job, lanes, buffer);
    }
    list_seen(box, group.size(), buffer);
    for (std::size_t i = 0; i < group.size(); ++i) {
        const auto pixels = listed(buffer, i);
        if (pixels.empty()) { continue; }
        cover_listed(pixels, buffer);
        count_covered(job, owners, *group[i].triangle, buffer, [](const glm::ivec2&) { return true; });
    }
}

HWY_INLINE bool has_holes(const TileTriangle& one) { return one.surface != nullptr && one.surface->texture->has_holes; }

std::uint64_t ColumnsWithoutHoles(
    const SurfacePlanes& surface, const glm::ivec2& tile_px, int row, std::uint64_t columns) {
    TileFragments fragments;
    for (std::uint64_t left = columns; left != 0; left &= left - 1) {
        fragments.add(static_cast<std::size_t>(row * tile_width + std::countr_zero(left)), 1);
    }
    remove_holes(surface, tile_px, fragments);
    std::uint64_t kept = 0;
    for (std::size_t i = 0; i < fragments.count; ++i) {
        kept |= std::uint64_t{1} << (fragments.pixels[i] % tile_width);
    }
    return kept;
}

void CountSamples(const TileJob& job, const SampleLanes& lanes, const SampleOwners& owners, TileBuffer& buffer) {
    buffer.covered.fill(0);
    buffer.sums[0].fill(0);
    buffer.full.fill(0);
    buffer.full_rows = 0;
    std::size_t end = job.triangles.size();
    while (end > 0 && buffer.full_rows != job.full_rows()) {
        std::size_t first = end - 1;
        const Triangle& triangle = *job.triangles[first].triangle;
        if (is_transparent_fill(job.triangles[first]) && triangle.depth == scene::DepthUse::None) {
            if (triangle.is_cloud) {
                cover(job.triangles[first], job, lanes, buffer);
                count_covered(job, owners, triangle, buffer,
                    [&](const glm::ivec2& at) { return is_cloud_at(triangle, job.first_px + at); });
            }
        } else if (triangle.group == 0) {
            const TileTriangle& one = job.triangles[first];
            if (triangle.is_under_side) {
                // left out, as find_middles() does
            } else if ((one.extra == nullptr || one.extra->cut_count == 0) && !has_holes(one)) {
                count_uncut(triangle, job, lanes, owners, buffer);
            } else {
                cover(one, job, lanes, buffer);
                count_covered(job, owners, triangle, buffer, [](const glm::ivec2&) { return true; });
            }
        } else {
            const auto belongs = [&](const TileTriangle& other) HWY_ATTR {
                return other.triangle->group == triangle.group &&
                       (!is_transparent_fill(other) || other.triangle->depth != scene::DepthUse::None);
            };
            while (first > 0 && belongs(job.triangles[first - 1])) { --first; }
            count_group(job, {first, end}, lanes, owners, buffer);
        }
        end = first;
    }
    for (std::size_t pixel = 0; pixel < TileBuffer::pixels; ++pixel) {
        if (owners.of_pixels[pixel] == 0) {
            const int free = 16 - std::popcount(buffer.covered[pixel]);
            buffer.sums[0][pixel] = static_cast<std::uint16_t>(buffer.sums[0][pixel] + free);
        }
    }
}

void PaintTile(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    reset(job, buffer);
    if (is_far_to_near(job, lanes)) {
        paint_far_to_near(job, lanes, buffer);
    } else {
        paint_near_to_far(job, lanes, buffer);
    }
    add_waiting(job, buffer);
    if (job.detail_texture != nullptr) { add_detail_texture(job, buffer); }
    resolve(job, buffer);
    if (job.deep != nullptr) { resolve_deep(job, buffer); }
    blend_transparent(job, buffer);
    paint_overlay(job, lanes, buffer);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::visuals::raster {

HWY_EXPORT(ColumnsWithoutHoles);
HWY_EXPORT(CountSamples);
HWY_EXPORT(PaintTile);

namespace {

/// Highway's set AVX3_DL is used with GFNI, which all its processors have but Highway does not ask for.
bool exclude_targets_without_gfni() {
#if HWY_ARCH_X86
    if (__builtin_cpu_supports("gfni") == 0) { hwy::DisableTargets(HWY_AVX3_DL); }
#endif
    return true;
}

} // namespace

std::uint64_t columns_without_holes(
    const SurfacePlanes& surface, const glm::ivec2& tile_px, int row, std::uint64_t columns) {
    static const bool may_choose = exclude_targets_without_gfni();
    static_cast<void>(may_choose);
    return HWY_DYNAMIC_DISPATCH(ColumnsWithoutHoles)(surface, tile_px, row, columns);
}

void count_samples(const TileJob& job, const SampleLanes& lanes, const SampleOwners& owners, TileBuffer& buffer) {
    static const bool may_choose = exclude_targets_without_gfni();
    static_cast<void>(may_choose);
    HWY_DYNAMIC_DISPATCH(CountSamples)(job, lanes, owners, buffer);
}

void paint_tile(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    static const bool may_choose = exclude_targets_without_gfni();
    static_cast<void>(may_choose);
    HWY_DYNAMIC_DISPATCH(PaintTile)(job, lanes, buffer);
}

SampleLanes::SampleLanes(const SamplePattern& pattern) : is_single_sample(pattern.reach == 0) {
    for (std::size_t lane = 0; lane < SamplePattern::lanes; ++lane) {
        down[lane] = pattern.y[lane];
        round_up[lane] = 0xffff - pattern.x[lane] * (65536 / SamplePattern::unit);
        x_px[lane] = static_cast<float>(pattern.x[lane]) / SamplePattern::unit;
        y_px[lane] = static_cast<float>(pattern.y[lane]) / SamplePattern::unit;
    }
}

} // namespace octant::visuals::raster
#endif
