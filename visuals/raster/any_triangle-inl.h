// Triangles of any fill, in two steps: coverage masks of 16 bits a pixel, then colour times newly covered samples. In
// this order: coverage; colour; groups of triangles that share a depth buffer; transparent triangles, which are
// recorded here and blended when the pixels behind them are known. Included once for each instruction set.
#if defined(OCTANT_RASTER_ANY_TRIANGLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_ANY_TRIANGLE_INL
#undef OCTANT_RASTER_ANY_TRIANGLE_INL
#else
#define OCTANT_RASTER_ANY_TRIANGLE_INL
#endif

#include "visuals/raster/gouraud_triangle-inl.h"
#include "visuals/raster/pixel_colour.h"
#include "visuals/raster/strip_coverage-inl.h"
#include "visuals/raster/textured_mesh-inl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// -- Triangles lie where they were set up, far apart for a tile: they are prefetched while others are painted.

constexpr std::size_t triangles_ahead = 12;

/// Prefetches a triangle into the cache, if there is one of that number.
HWY_INLINE void prefetch_triangle(std::span<const TileTriangle> triangles, std::size_t number) {
    if (number >= triangles.size()) { return; }
    const auto prefetch = [](const auto* from) HWY_ATTR {
        constexpr std::size_t cache_line = 64;
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(from);
        for (std::size_t at = 0; at < sizeof(*from); at += cache_line) { hwy::Prefetch(bytes + at); }
    };
    const TileTriangle& one = triangles[number];
    prefetch(one.triangle);
    if (one.surface != nullptr) { prefetch(one.surface); }
    if (one.extra != nullptr) {
        hwy::Prefetch(&one.extra->depth);
        hwy::Prefetch(&one.extra->cut_count);
    }
}

// -- Coverage: which samples of a tile a triangle covers, a mask of sixteen bits for each pixel.

/// Columns of a row that may be covered.
struct RowSpan {
    int first;
    int last;
};

/// Narrows a row to the columns that two edges cross or enclose, both of which go through the whole row. Edges are
/// those of the tile's first column.
HWY_INLINE void narrow(const MiddleEdge& left, const MiddleEdge& right, RowSpan& span) {
    const auto reach = [](const MiddleEdge& edge) {
        constexpr std::int64_t half_px = std::int64_t{1} << 31;
        return std::abs(static_cast<std::int64_t>(edge.slope)) / 2 + half_px;
    };
    const auto column = [](std::int64_t x) {
        return static_cast<int>(std::clamp<std::int64_t>(x >> 32, -1, tile_width));
    };
    span.first = std::max(span.first, column(static_cast<std::int64_t>(left.x) - reach(left)));
    span.last = std::min(span.last, column(static_cast<std::int64_t>(right.x) + reach(right)) + 1);
}

/// Finds the columns of each row that a triangle may cover, none where nearer ones cover them whole.
HWY_INLINE void find_spans(const Triangle& triangle, const TileJob& job, const TileBox& box, TileBuffer& buffer) {
    const glm::ivec2 first_px = job.first_px + glm::ivec2(0, box.first_row);
    MiddleEdge whole(triangle.whole, triangle.top, first_px);
    MiddleEdge upper(triangle.upper, triangle.top, first_px);
    MiddleEdge lower(triangle.lower, triangle.middle, first_px);
    for (int row = box.first_row; row <= box.last_row; ++row) {
        const std::int32_t above = (job.first_px.y + row) * 256 - 128;
        const std::int32_t below = above + 256;
        const bool is_upper = below <= triangle.middle;
        RowSpan span{box.left, box.right};
        if (above >= triangle.top && below <= triangle.bottom && (is_upper || above >= triangle.middle)) {
            const MiddleEdge& bent = is_upper ? upper : lower;
            narrow(triangle.middle_is_left ? bent : whole, triangle.middle_is_left ? whole : bent, span);
        }
        Coverage::Row& places = buffer.coverage.rows[static_cast<std::size_t>(row)];
        places.blocks = 0;
        if (span.first <= span.last) {
            const std::uint64_t columns = (~std::uint64_t{0} << span.first) & (~std::uint64_t{0} >> (63 - span.last));
            const bool is_free = (columns & ~buffer.full[static_cast<std::size_t>(row)]) != 0;
            places = {span.first, span.last, is_free ? (span.last - span.first) / block_px + 1 : 0};
        }
        for (MiddleEdge* edge : {&whole, &upper, &lower}) { edge->x += edge->slope; }
    }
}

/// The pixels of a strip, for each sample, in which the sample lies on the inner side of all clip lines of a triangle.
/// The strip begins at a column and row of the tile.
HWY_INLINE LaneMasks pixels_within(
    const TriangleExtra& extra, const SampleLanes& lanes, const glm::ivec2& tile_px, const glm::ivec2& strip) {
    alignas(64) std::array<std::int32_t, SamplePattern::lanes> first;
    alignas(64) std::array<std::int32_t, SamplePattern::lanes> end;
    first.fill(0);
    end.fill(tile_width);
    for (int k = 0; k < extra.cut_count; ++k) {
        const ClipLine& line = extra.cuts[static_cast<std::size_t>(k)];
        const double at_tile = line.c + line.a * tile_px.x + line.b * (tile_px.y + strip.y);
        for (std::size_t lane = 0; lane < SamplePattern::lanes; ++lane) {
            const double here = at_tile + line.b * static_cast<double>(lanes.y_px[lane]) +
                                line.a * static_cast<double>(lanes.x_px[lane]);
            const double column = line.a == 0.0 ? 0.0 : std::clamp(-here / line.a, -1.0, 1.0 + tile_width);
            if (line.a > 0.0) {
                first[lane] = std::max(first[lane], static_cast<std::int32_t>(std::ceil(column)));
            } else if (line.a < 0.0) {
                end[lane] = std::min(end[lane], static_cast<std::int32_t>(std::floor(column)) + 1);
            } else if (here < 0.0) {
                end[lane] = 0;
            }
        }
    }
    const auto columns_left = hn::Set(Lanes(), strip.x);
    const LaneValues from = load_lanes(first.data());
    const LaneValues to = load_lanes(end.data());
    LaneMasks within;
    for (std::size_t i = 0; i < lane_parts; ++i) {
        within[i] = hn::AndNot(pixels_from(hn::Sub(to[i], columns_left)), pixels_from(hn::Sub(from[i], columns_left)));
    }
    return within;
}

/// Writes the masks of the samples that a triangle covers into TileBuffer::masks, for rows that are not covered whole
/// by nearer ones.
HWY_NOINLINE void cover(const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const Triangle& triangle = *one.triangle;
    const TileBox box(triangle, job);
    Coverage& coverage = buffer.coverage;
    coverage.first_row = box.first_row;
    coverage.last_row = (box.rows() & ~buffer.full_rows) == 0 ? -1 : box.last_row;
    if (coverage.last_row < 0) { return; }
    find_spans(triangle, job, box, buffer);
    const bool is_cut = one.extra != nullptr && one.extra->cut_count > 0;
    for (int left = box.left; left <= box.right; left += strip_px) {
        const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
        StripCoverage strip(triangle, first_px, box.columns_of_strip(left), lanes);
        for (int row = box.first_row; row <= box.last_row; ++row) {
            const Coverage::Row& places = coverage.rows[static_cast<std::size_t>(row)];
            if (places.blocks > 0 && places.first < left + strip_px && places.last >= left) {
                LaneMasks pixels = strip.lanes();
                if (is_cut) {
                    const LaneMasks within = pixels_within(*one.extra, lanes, job.first_px, {left, row});
                    for (std::size_t i = 0; i < lane_parts; ++i) { pixels[i] = hn::And(pixels[i], within[i]); }
                }
                const StripValues masks = samples_of_pixels(pixels);
                std::uint16_t* const to =
                    buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row + left;
                for (std::size_t i = 0; i < strip_parts; ++i) { hn::StoreU(masks[i], Strip(), to + i * part_px); }
                std::fill_n(to + strip_px, block_px, std::uint16_t{0}); // the last block may end beyond the strip
            }
            strip.next_row();
        }
    }
    if (one.surface != nullptr && one.surface->texture->has_holes) { remove_holes(one, job, buffer); }
}

// -- Colour of the samples that no nearer triangle covers.

using Pixels = hn::CappedTag<std::uint16_t, 16>;
using PixelsSigned = hn::RebindToSigned<Pixels>;
using Counts = hn::Vec<Pixels>;

/// Takes the samples of a few pixels that are still free; none at all: `false`. Covers them.
HWY_INLINE bool take_free(
    const std::uint16_t* masks, std::uint16_t* covered, hn::Vec<Pixels>& fresh, std::uint64_t& full) {
    const Pixels px;
    const auto before = hn::LoadU(px, covered);
    fresh = hn::AndNot(before, hn::LoadU(px, masks));
    if (hn::AllTrue(px, hn::Eq(fresh, hn::Zero(px)))) { return false; }
    const auto after = hn::Or(before, fresh);
    hn::StoreU(after, px, covered);
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
    const auto level = hn::Min(hn::Max(raw, hn::Set(sign, gradients.min[k])), hn::Set(sign, gradients.max[k]));
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
    constexpr double most = 250.0; // levels from the middle: in 16 bits, as is all between two such ends
    for (std::size_t i = 0; i < walk.base.size(); ++i) {
        const double here = std::clamp(extra.over_w[i].at(column, row) * w_here, 128.0 - most, 128.0 + most);
        const double there = std::clamp(extra.over_w[i].at(end, row) * w_end, 128.0 - most, 128.0 + most);
        const double per_px = (there - here) / (end - column);
        walk.base[i] = static_cast<std::int32_t>((here - 128.0) * 128.0);
        walk.per_px[i] = static_cast<std::int16_t>(std::clamp(per_px, -most, most) * 128.0);
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
    if (one.surface != nullptr) {
        take_fragments(job, buffer);
        add_fragments(one, job, buffer);
        return;
    }
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
                hn::Vec<Pixels> fresh;
                std::uint64_t full = 0;
                if (!take_free(masks + i, buffer.covered.data() + pixel + i, fresh, full)) { continue; }
                const Counts counts = hn::PopulationCount(fresh);
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
                    put_ground(Pixels(), triangle, job, from, fresh, buffer);
                }
            }
        }
        if ((buffer.full[static_cast<std::size_t>(at)] & job.full_row()) == job.full_row()) {
            buffer.full_rows |= std::uint32_t{1} << at;
        }
    }
}

// -- Groups of triangles that share a depth buffer: each triangle is drawn sample by sample, from first to last. The
// samples that a triangle wins are then coloured like those of any other triangle, where nothing nearer covers them.

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
    for_each_covered(job, buffer, [&](const glm::ivec2& at, std::size_t pixel, std::uint32_t mask) HWY_ATTR {
        draw_pixel(mask, walk.at(at.x, at.y), walk, one.triangle->depth, name, buffer.depth.data() + pixel * samples,
            buffer.seen.data() + pixel * samples);
    });
}

/// The covered samples of a pixel where a transparent triangle is nearer than what is there.
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

/// Joins two adjacent triangles of one pixel, so that no line shows where they meet.
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

/// Records what is seen of a transparent triangle in a pixel, to be blended later over those of its group that were
/// recorded before. Of two surfaces beside one another in a pixel, of which one comes from a nearer group, the share is
/// that of both together, too.
HWY_INLINE void record(const TransparentPixel& transparent, TileBuffer& buffer, bool is_surface) {
    if (transparent.share == 0) { return; }
    std::uint32_t& last = buffer.last_transparent[transparent.pixel];
    std::uint32_t& only = buffer.only_transparent[transparent.pixel];
    const bool is_alone = last == 0 && only != 0 && only != TileBuffer::several && is_surface;
    const std::uint32_t beside = is_alone ? only : last;
    if (beside != 0 && (buffer.transparent_pixels[beside - 1].mask & transparent.mask) == 0) {
        join(transparent, buffer.transparent_pixels[beside - 1]);
        return;
    }
    buffer.transparent_pixels.push_back(transparent);
    last = static_cast<std::uint32_t>(buffer.transparent_pixels.size());
    only = only == 0 && is_surface ? last : TileBuffer::several;
}

HWY_INLINE void begin_record(TileBuffer& buffer) {
    buffer.last_transparent.resize(TileBuffer::pixels, 0);
    buffer.only_transparent.resize(TileBuffer::pixels, 0);
}

/// Ends a group of recorded pixels, of which `first` is the first one.
HWY_INLINE void end_record(std::size_t first, TileBuffer& buffer) {
    if (buffer.transparent_pixels.size() == first) { return; }
    buffer.group_first_transparent.push_back(first);
    for (std::size_t i = first; i < buffer.transparent_pixels.size(); ++i) {
        buffer.last_transparent[buffer.transparent_pixels[i].pixel] = 0;
    }
}

/// Records where a triangle of a transparent surface, whose coverage is at hand, is seen. `seen_of(place in the tile,
/// pixel, samples not behind nearer groups)` says in which of these samples.
template <class SeenOf>
HWY_INLINE void record_surface(const TileTriangle& one, const TileJob& job, TileBuffer& buffer, const SeenOf& seen_of) {
    buffer.fragments.count = 0;
    for_each_covered(job, buffer, [&](const glm::ivec2& at, std::size_t pixel, std::uint32_t mask) HWY_ATTR {
        const auto free = mask & ~std::uint32_t{buffer.covered[pixel]};
        if (free == 0) { return; }
        const std::uint32_t seen = seen_of(at, pixel, free);
        if (seen != 0 && one.surface != nullptr) {
            buffer.fragments.add(pixel, seen);
        } else if (seen != 0) {
            record({static_cast<std::uint16_t>(pixel), static_cast<std::uint16_t>(seen),
                       colour_of(one, job, job.first_px.x + at.x, job.first_px.y + at.y),
                       TransparentPixel::share_of(one.extra->opacity, std::popcount(seen))},
                buffer, true);
        }
    });
    if (one.surface == nullptr) { return; }
    const float opacity = one.extra->opacity;
    const float share = one.surface->texture->has_share_of_own ? opacity / 65535.0F : 0.0F;
    for_each_fragment(one, job, buffer.fragments,
        [&](std::size_t pixel, std::uint32_t seen, const PixelColour& colour, std::uint32_t alpha) HWY_ATTR {
            const float own = share > 0.0F ? share * static_cast<float>(alpha) : opacity;
            record({static_cast<std::uint16_t>(pixel), static_cast<std::uint16_t>(seen), colour,
                       TransparentPixel::share_of(own, std::popcount(seen))},
                buffer, true);
        });
}

HWY_INLINE bool is_transparent_fill(const TileTriangle& one) { return one.triangle->fill == Fill::Transparent; }

HWY_INLINE bool is_transparent_surface(const TileTriangle& one) {
    return one.extra != nullptr && one.extra->opacity < 1.0F;
}

/// As record_surface(), of a triangle with Fill::Transparent.
template <class SeenOf>
HWY_INLINE void record_fill(const TileTriangle& one, const TileJob& job, TileBuffer& buffer, const SeenOf& seen_of) {
    for_each_covered(job, buffer, [&](const glm::ivec2& at, std::size_t pixel, std::uint32_t mask) HWY_ATTR {
        const auto free = mask & ~std::uint32_t{buffer.covered[pixel]};
        if (free == 0) { return; }
        const std::uint32_t seen = seen_of(at, pixel, free);
        if (seen == 0) { return; }
        const auto sixteenths = [&](std::size_t k) {
            return sixteenths_of(one.triangle->gradients.level(k, job.first_px + at));
        };
        const auto alpha = (sixteenths(3) * 4096U + 2040U) / 4080U;
        const std::uint32_t share = alpha * static_cast<std::uint32_t>(std::popcount(seen)) >> 4U;
        record({static_cast<std::uint16_t>(pixel), static_cast<std::uint16_t>(seen),
                   {sixteenths(0), sixteenths(1), sixteenths(2)}, static_cast<std::uint16_t>(share)},
            buffer, false);
    });
}

/// Records where a transparent triangle is seen: not behind nearer triangles of its group or of others.
HWY_INLINE void record_by_depth(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const DepthStepper walk(*one.extra, job, lanes);
    const auto nearer = [&](const glm::ivec2& at, std::size_t pixel, std::uint32_t free) HWY_ATTR {
        return nearer_samples(free, walk.at(at.x, at.y), walk, buffer.depth.data() + pixel * samples);
    };
    if (is_transparent_fill(one)) {
        record_fill(one, job, buffer, nearer);
    } else {
        record_surface(one, job, buffer, nearer);
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

/// Lists the samples of the pixels of a group's box by the triangles that they show.
HWY_INLINE void list_seen(const GroupBox& box, std::size_t triangles, TileBuffer& buffer) {
    buffer.found.clear();
    buffer.first_seen.assign(triangles + 2, 0);
    for (int row = box.first_row; row <= box.last_row; ++row) {
        for (int column = box.left; column <= box.right; ++column) {
            const auto pixel = static_cast<std::size_t>(row * tile_width + column);
            const std::uint32_t* const seen = buffer.seen.data() + pixel * samples;
            std::uint32_t left = 0xffffU;
            while (left != 0) {
                const std::uint32_t name = seen[std::countr_zero(left)];
                const std::uint32_t showing = samples_showing(name, seen);
                left &= ~showing;
                if (name == 0) { continue; }
                ++buffer.first_seen[name];
                buffer.found.push_back({name, static_cast<std::uint16_t>(pixel), static_cast<std::uint16_t>(showing)});
            }
        }
    }
    std::uint32_t end = 0; // of the pixels of the names so far
    for (std::uint32_t& first : buffer.first_seen) {
        const std::uint32_t count = first;
        first = end;
        end += count;
    }
    buffer.seen_pixels.resize(buffer.found.size());
    for (const TileBuffer::SeenPixel& one : buffer.found) { buffer.seen_pixels[buffer.first_seen[one.name]++] = one; }
    // Each entry has moved to the end of its own pixels: to the first of the next name.
    std::copy_backward(buffer.first_seen.begin(), buffer.first_seen.end() - 1, buffer.first_seen.end());
    buffer.first_seen.front() = 0;
}

/// The listed pixels of a triangle, row after row, by its place in the group.
HWY_INLINE std::span<const TileBuffer::SeenPixel> listed(const TileBuffer& buffer, std::size_t triangle) {
    const std::uint32_t first = buffer.first_seen[triangle + 1];
    return std::span(buffer.seen_pixels).subspan(first, buffer.first_seen[triangle + 2] - first);
}

/// Makes listed samples of a textured triangle fragments, and covers them.
HWY_INLINE void take_seen(std::span<const TileBuffer::SeenPixel> pixels, const TileJob& job, TileBuffer& buffer) {
    buffer.fragments.count = 0;
    for (const TileBuffer::SeenPixel& one : pixels) { take_fragment(one.pixel, one.samples, buffer); }
    note_full_rows(job, pixels.front().pixel / tile_width, pixels.back().pixel / tile_width, buffer);
}

/// Makes listed samples of a triangle its coverage.
HWY_INLINE void cover_listed(std::span<const TileBuffer::SeenPixel> pixels, TileBuffer& buffer) {
    const auto row_of = [](const TileBuffer::SeenPixel& one) { return one.pixel / tile_width; };
    const auto column_of = [](const TileBuffer::SeenPixel& one) { return one.pixel % tile_width; };
    Coverage& coverage = buffer.coverage;
    coverage.first_row = row_of(pixels.front());
    coverage.last_row = row_of(pixels.back());
    for (int row = coverage.first_row; row <= coverage.last_row; ++row) {
        const std::size_t end = static_cast<std::size_t>(
            std::ranges::find_if(pixels, [&](const auto& one) { return row_of(one) != row; }) - pixels.begin());
        Coverage::Row& places = coverage.rows[static_cast<std::size_t>(row)];
        places = {0, -1, 0};
        if (end == 0) { continue; }
        places.first = column_of(pixels.front());
        places.last = column_of(pixels[end - 1]);
        places.blocks = (places.last - places.first) / block_px + 1;
        std::uint16_t* const masks = buffer.masks.data() + static_cast<std::size_t>(row) * TileBuffer::mask_row;
        std::fill_n(masks + places.first, places.blocks * block_px, std::uint16_t{0});
        for (const TileBuffer::SeenPixel& one : pixels.first(end)) { masks[column_of(one)] = one.samples; }
        pixels = pixels.subspan(end);
    }
}

/// Triangles first .. end - 1 of the job are a group.
HWY_INLINE void paint_group(
    const TileJob& job, const std::array<std::size_t, 2>& range, const SampleLanes& lanes, TileBuffer& buffer) {
    const auto group = job.triangles.subspan(range[0], range[1] - range[0]);
    const GroupBox box = box_of(group, job);
    if (box.left > box.right || box.first_row > box.last_row) { return; }
    clear_group(box, buffer);
    const std::size_t transparent_before = buffer.transparent_pixels.size();
    for (std::size_t i = 0; i < group.size(); ++i) {
        prefetch_triangle(group, i + triangles_ahead);
        cover(group[i], job, lanes, buffer);
        if (is_transparent_fill(group[i]) || is_transparent_surface(group[i])) {
            begin_record(buffer);
            record_by_depth(group[i], job, lanes, buffer);
        } else {
            draw_by_depth(group[i], static_cast<std::uint32_t>(i + 1), job, lanes, buffer);
        }
    }
    end_record(transparent_before, buffer);
    // Each of its samples shows one triangle: they are coloured in any order.
    list_seen(box, group.size(), buffer);
    for (std::size_t i = 0; i < group.size(); ++i) {
        const auto pixels = listed(buffer, i);
        prefetch_triangle(group, i + triangles_ahead);
        if (pixels.empty()) { continue; }
        if (group[i].surface != nullptr) {
            take_seen(pixels, job, buffer);
            add_fragments(group[i], job, buffer);
        } else {
            cover_listed(pixels, buffer);
            fill(group[i], job, buffer);
        }
    }
}

// -- Transparent triangles (clouds, ribbons, exhaust; glass in painting order). The tile is painted from near to far,
// so a transparent triangle covers nothing: its uncovered samples are recorded, and blended when the colours behind it
// are known.

/// Whether a triangle is blended over what was painted before it, without depth.
HWY_INLINE bool is_blended_in_order(const TileTriangle& one) {
    return is_transparent_fill(one) ? one.triangle->depth == scene::DepthUse::None
                                    : one.triangle->group == 0 && is_transparent_surface(one);
}

/// Records where transparent triangles that follow each other in the tile's list are seen.
HWY_NOINLINE void record_transparent(
    std::span<const TileTriangle> transparents, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const std::size_t first = buffer.transparent_pixels.size();
    begin_record(buffer);
    const auto all = [](const glm::ivec2&, std::size_t, std::uint32_t free) HWY_ATTR { return free; };
    for (const TileTriangle& one : transparents) {
        cover(one, job, lanes, buffer);
        if (is_transparent_fill(one)) {
            record_fill(one, job, buffer, all);
        } else {
            record_surface(one, job, buffer, all);
        }
    }
    end_record(first, buffer);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
