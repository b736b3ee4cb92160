// Groups of triangles that are drawn by depth: sample by sample, from first to last; what is seen of a group is then
// coloured like any triangle, where nothing nearer covers it. Included once for each instruction set.
#if defined(OCTANT_RASTER_DEPTH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_DEPTH_INL
#undef OCTANT_RASTER_DEPTH_INL
#else
#define OCTANT_RASTER_DEPTH_INL
#endif

#include "visuals/raster/pixel_colour.h"
#include "visuals/raster/strip_gradient-inl.h"
#include "visuals/raster/tile_coverage-inl.h"
#include "visuals/raster/tile_fill-inl.h"

#include <bit>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using Depths = hn::CappedTag<float, 16>;
using Seen = hn::RebindToUnsigned<Depths>;
constexpr std::size_t samples = SamplePattern::lanes;

/// Pixels of a tile that a group may cover.
struct GroupBox {
    int left = tile_width;
    int right = -1;
    int first_row = tile_height;
    int last_row = -1;
};

HWY_INLINE GroupBox box_of(std::span<const TileTriangle> group, const TileJob& job) {
    GroupBox box;
    for (const TileTriangle& one : group) {
        const Triangle& triangle = *one.triangle;
        box.left = std::min(box.left, triangle.left - job.first_px.x);
        box.right = std::max(box.right, triangle.right - job.first_px.x);
        box.first_row = std::min(box.first_row, triangle.first_row - job.first_px.y);
        box.last_row = std::max(box.last_row, triangle.last_row - job.first_px.y);
    }
    box.left = std::max(box.left, 0);
    box.right = std::min(box.right, job.size_px.x - 1);
    box.first_row = std::max(box.first_row, 0);
    box.last_row = std::min(box.last_row, job.size_px.y - 1);
    return box;
}

HWY_INLINE void clear_group(const GroupBox& box, TileBuffer& buffer) {
    buffer.depth.resize(TileBuffer::pixels * samples);
    buffer.seen.resize(TileBuffer::pixels * samples);
    for (int row = box.first_row; row <= box.last_row; ++row) {
        const auto from = static_cast<std::size_t>(row * tile_width + box.left) * samples;
        const auto count = static_cast<std::size_t>(box.right - box.left + 1) * samples;
        std::fill_n(buffer.depth.data() + from, count, 0.0F);
        std::fill_n(buffer.seen.data() + from, count, 0U);
    }
}

/// The depths of a triangle at the samples of a pixel: its own plus one for each sample.
struct DepthStepper {
    AttributePlane middle; ///< at pixel middles, from the tile's first: steep planes cancel much
    alignas(64) std::array<float, samples> of_sample{};

    DepthStepper(const TriangleExtra& extra, const TileJob& job, const SampleLanes& lanes) {
        const auto share = static_cast<double>(extra.depth_share);
        middle.base = extra.depth.at(job.first_px.x, job.first_px.y) * share;
        middle.per_x = extra.depth.per_x * share;
        middle.per_y = extra.depth.per_y * share;
        const auto per_x = static_cast<float>(middle.per_x);
        const auto per_y = static_cast<float>(middle.per_y);
        for (std::size_t lane = 0; lane < samples; ++lane) {
            of_sample[lane] = per_x * lanes.x_px[lane] + per_y * lanes.y_px[lane];
        }
    }

    float at(int column, int row) const { return static_cast<float>(middle.at(column, row)); }
};

/// Draws the covered samples of a pixel by depth.
HWY_INLINE void draw_pixel(std::uint32_t mask, float pixel_depth, const DepthStepper& walk, scene::DepthUse use,
    std::uint32_t name, float* depth, std::uint32_t* seen) {
    using Use = scene::DepthUse;
    const Depths real;
    const Seen whole;
    const std::size_t at_once = hn::Lanes(real);
    for (std::size_t lane = 0; lane < samples; lane += at_once) {
        const auto bit = hn::Shl(hn::Set(whole, 1U), lane_indices_from(whole, lane));
        const auto covered = hn::RebindMask(real, hn::Ne(hn::And(hn::Set(whole, mask), bit), hn::Zero(whole)));
        const auto before = hn::LoadU(real, depth + lane);
        const auto here = hn::Add(hn::Set(real, pixel_depth), hn::Load(real, walk.of_sample.data() + lane));
        auto passes = covered;
        if (use == Use::OnGround || use == Use::InfinitelyFar) {
            passes = hn::And(covered, hn::Ge(here, before));
        } else if (use != Use::None) {
            passes = hn::And(covered, hn::Gt(here, before));
        }
        if (use != Use::None && use != Use::InfinitelyFar) {
            hn::StoreU(hn::IfThenElse(passes, here, before), real, depth + lane);
        }
        if (use != Use::DepthOnly) {
            const auto last = hn::LoadU(whole, seen + lane);
            hn::StoreU(hn::IfThenElse(hn::RebindMask(whole, passes), hn::Set(whole, name), last), whole, seen + lane);
        }
    }
}

HWY_INLINE void draw_by_depth(
    const TileTriangle& one, std::uint32_t name, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const DepthStepper walk(*one.extra, job, lanes);
    const scene::DepthUse use = one.triangle->depth;
    const Coverage& coverage = buffer.coverage;
    for (int row = coverage.first_row; row <= coverage.last_row; ++row) {
        const Coverage::Row places = coverage.rows[static_cast<std::size_t>(row)];
        const int end = std::min(places.first + places.blocks * 16, job.size_px.x);
        const std::uint16_t* const masks = buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row;
        for (int column = places.first; column < end; ++column) {
            const std::uint32_t mask = masks[column];
            if (mask == 0) { continue; }
            const auto sample = static_cast<std::size_t>(row * tile_width + column) * samples;
            draw_pixel(
                mask, walk.at(column, row), walk, use, name, buffer.depth.data() + sample, buffer.seen.data() + sample);
        }
    }
}

/// The covered samples of a pixel where a clear triangle is nearer than what is there.
HWY_INLINE std::uint32_t nearer_samples(
    std::uint32_t mask, float pixel_depth, const DepthStepper& walk, const float* depth) {
    const Depths real;
    std::uint32_t nearer = 0;
    for (std::size_t lane = 0; lane < samples; lane += hn::Lanes(real)) {
        alignas(8) std::array<std::uint8_t, 8> some{};
        const auto here = hn::Add(hn::Set(real, pixel_depth), hn::Load(real, walk.of_sample.data() + lane));
        hn::StoreMaskBits(real, hn::Gt(here, hn::LoadU(real, depth + lane)), some.data());
        nearer |= static_cast<std::uint32_t>(some[0] | some[1] << 8) << lane;
    }
    return nearer & mask;
}

/// Notes where a clear triangle is seen: before its group, and not behind nearer ones.
HWY_INLINE void record_transparent_surface(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const DepthStepper walk(*one.extra, job, lanes);
    const Coverage& coverage = buffer.coverage;
    for (int row = coverage.first_row; row <= coverage.last_row; ++row) {
        const Coverage::Row places = coverage.rows[static_cast<std::size_t>(row)];
        const int end = std::min(places.first + places.blocks * 16, job.size_px.x);
        const std::uint16_t* const masks = buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row;
        for (int column = places.first; column < end; ++column) {
            const auto pixel = static_cast<std::size_t>(row * tile_width + column);
            const auto free = static_cast<std::uint32_t>(masks[column] & ~buffer.covered[pixel]);
            if (free == 0) { continue; }
            const std::uint32_t seen =
                nearer_samples(free, walk.at(column, row), walk, buffer.depth.data() + pixel * samples);
            if (seen != 0) {
                buffer.transparent_pixels.push_back(
                    {static_cast<std::uint16_t>(pixel), static_cast<std::uint16_t>(seen),
                        colour_of(one, job, job.first_px.x + column, job.first_px.y + row),
                        TransparentPixel::share_of(one.extra->opacity, std::popcount(seen))});
            }
        }
    }
}

/// The samples of a pixel that show a triangle of its group.
HWY_INLINE std::uint16_t samples_showing(std::uint32_t name, const std::uint32_t* seen) {
    const Seen whole;
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < samples; lane += hn::Lanes(whole)) {
        alignas(8) std::array<std::uint8_t, 8> some{};
        hn::StoreMaskBits(whole, hn::Eq(hn::LoadU(whole, seen + lane), hn::Set(whole, name)), some.data());
        bits |= static_cast<std::uint32_t>(some[0] | some[1] << 8) << lane;
    }
    return static_cast<std::uint16_t>(bits);
}

/// Makes what is seen of a triangle of a group its coverage.
HWY_INLINE void cover_seen(const TileTriangle& one, std::uint32_t name, const TileJob& job, TileBuffer& buffer) {
    const TileBox box(*one.triangle, job);
    buffer.coverage.first_row = box.first_row;
    buffer.coverage.last_row = box.last_row;
    for (int row = box.first_row; row <= box.last_row; ++row) {
        std::uint16_t* const masks = buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row;
        int first = box.right + 1;
        int last = box.left - 1;
        for (int column = box.left; column <= box.right; ++column) {
            const auto pixel = static_cast<std::size_t>(row * tile_width + column);
            masks[column] = samples_showing(name, buffer.seen.data() + pixel * samples);
            first = masks[column] != 0 ? std::min(first, column) : first;
            last = masks[column] != 0 ? column : last;
        }
        std::fill_n(masks + box.right + 1, block_px, std::uint16_t{0});
        const int blocks = first <= last ? (last - first) / block_px + 1 : 0;
        buffer.coverage.rows[static_cast<std::size_t>(row)] = {first, last, blocks};
    }
}

/// Triangles first .. end - 1 of the job are a group.
HWY_INLINE void paint_group(
    const TileJob& job, const std::array<std::size_t, 2>& range, const SampleLanes& lanes, TileBuffer& buffer) {
    const auto group = job.triangles.subspan(range[0], range[1] - range[0]);
    const GroupBox box = box_of(group, job);
    if (box.left > box.right || box.first_row > box.last_row) { return; }
    clear_group(box, buffer);
    const std::size_t clear_before = buffer.transparent_pixels.size();
    for (std::size_t i = 0; i < group.size(); ++i) {
        cover(group[i], job, lanes, buffer);
        if (group[i].extra->opacity < 1.0F) {
            record_transparent_surface(group[i], job, lanes, buffer);
        } else {
            draw_by_depth(group[i], static_cast<std::uint32_t>(i + 1), job, lanes, buffer);
        }
    }
    if (buffer.transparent_pixels.size() > clear_before) { buffer.group_first_transparent.push_back(clear_before); }
    // Each of its samples shows one triangle: they are coloured in any order.
    for (std::size_t i = 0; i < group.size(); ++i) {
        cover_seen(group[i], static_cast<std::uint32_t>(i + 1), job, buffer);
        fill(group[i], job, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
