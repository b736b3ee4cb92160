// Paints one tile. Compiled once for each instruction set; all give the same bits, because colours and crossings are
// whole numbers and real ones are summed and multiplied one by one.
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

#include "visuals/raster/perspective_texture-inl.h"
#include "visuals/raster/reference_rasterizer-inl.h"
#include "visuals/raster/tile_affine_triangle-inl.h"
#include "visuals/raster/tile_coverage-inl.h"
#include "visuals/raster/tile_depth-inl.h"
#include "visuals/raster/tile_detail_texture-inl.h"
#include "visuals/raster/tile_fill-inl.h"
#include "visuals/raster/tile_gouraud-inl.h"
#include "visuals/raster/tile_picture-inl.h"
#include "visuals/raster/tile_transparent-inl.h"

#include <cstddef>
#include <cstdint>
#include <hwy/cache_control.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// Paints a triangle that has no depth.
HWY_INLINE void paint_one(const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const Fill fill_with = one.triangle->fill;
    if (fill_with == Fill::Gouraud && one.extra == nullptr) {
        if (job.detail_texture == nullptr) {
            paint_gouraud<PaintAs::Plain>(*one.triangle, job, lanes, buffer);
        } else if (one.triangle->has_detail_texture) {
            paint_gouraud<PaintAs::Ground>(*one.triangle, job, lanes, buffer);
        } else {
            paint_gouraud<PaintAs::Beside>(*one.triangle, job, lanes, buffer);
        }
    } else if (fill_with == Fill::Texture) {
        paint_affine_triangle(*one.triangle, job, lanes, buffer);
    } else if (fill_with == Fill::TextureInPerspective && one.extra->cut_count == 0) {
        paint_texture(one, job, lanes, buffer);
    } else {
        cover(one, job, lanes, buffer);
        fill(one, job, buffer);
    }
}

/// Triangles lie where they were set up, far apart for a tile: they are on their way from memory while others are
/// painted.
HWY_INLINE void prefetch_triangle(const TileJob& job, std::size_t end) {
    constexpr std::size_t ahead = 4;
    constexpr std::size_t cache_line = 64;
    if (end >= ahead) {
        const auto* const from = reinterpret_cast<const std::uint8_t*>(job.triangles[end - ahead].triangle);
        for (std::size_t at = 0; at < sizeof(Triangle); at += cache_line) { hwy::Prefetch(from + at); }
    }
}

HWY_INLINE void paint_near_to_far(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    std::size_t end = job.triangles.size();
    while (end > 0 && buffer.full_rows != job.full_rows()) {
        prefetch_triangle(job, end);
        const std::uint16_t group = job.triangles[end - 1].triangle->group;
        std::size_t first = end - 1;
        if (is_transparent_fill(job.triangles[first])) {
            while (first > 0 && is_transparent_fill(job.triangles[first - 1])) { --first; }
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

void PaintTile(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    clear(job, buffer);
    buffer.transparent_pixels.clear();
    buffer.group_first_transparent.clear();
    if (is_painted_over(job, lanes)) {
        paint_over(job, lanes, buffer);
    } else {
        paint_near_to_far(job, lanes, buffer);
    }
    if (job.detail_texture != nullptr) { add_detail_texture(job, buffer); }
    resolve(job, buffer);
    blend_transparent(job, buffer);
    paint_overlay(job, lanes, buffer);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::visuals::raster {

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

void paint_tile(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    static const bool may_choose = exclude_targets_without_gfni();
    static_cast<void>(may_choose);
    HWY_DYNAMIC_DISPATCH(PaintTile)(job, lanes, buffer);
}

SampleLanes::SampleLanes(const SamplePattern& pattern) : are_one(pattern.reach == 0) {
    for (std::size_t lane = 0; lane < SamplePattern::lanes; ++lane) {
        down[lane] = pattern.y[lane];
        round_up[lane] = 0xffff - pattern.x[lane] * (65536 / SamplePattern::unit);
        x_px[lane] = static_cast<float>(pattern.x[lane]) / SamplePattern::unit;
        y_px[lane] = static_cast<float>(pattern.y[lane]) / SamplePattern::unit;
    }
    for (std::int32_t place = -128; place <= 128; ++place) {
        std::uint8_t& above = lanes_above[static_cast<std::size_t>(place + 128)];
        for (const std::int32_t y : pattern.y) {
            above = static_cast<std::uint8_t>(above + (y * 256 / SamplePattern::unit < place ? 1 : 0));
        }
    }
}

} // namespace octant::visuals::raster
#endif
