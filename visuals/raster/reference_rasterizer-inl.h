// The ways that the walk from near to far is compared with, one sample a pixel: from far to near, each triangle over
// what is there (painter's), and in any order by a depth for each pixel. Included once for each instruction set.
#if defined(OCTANT_RASTER_REFERENCE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_REFERENCE_INL
#undef OCTANT_RASTER_REFERENCE_INL
#else
#define OCTANT_RASTER_REFERENCE_INL
#endif

#include "visuals/raster/any_triangle-inl.h"
#include "visuals/raster/gouraud_triangle-inl.h"

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// How a triangle's depths are compared.
struct DepthRule {
    bool compares;
    bool passes_equal;
    bool writes;
    bool colours;

    explicit DepthRule(scene::DepthUse use)
        : compares(use != scene::DepthUse::None),
          passes_equal(use == scene::DepthUse::OnGround || use == scene::DepthUse::InfinitelyFar),
          writes(use != scene::DepthUse::InfinitelyFar), colours(use != scene::DepthUse::DepthOnly) {}
};

/// Compares a row's pixels, a bit each, with the depths from `depth` on and writes those that pass. Depths go on from
/// `first` by `per_px`.
HWY_INLINE std::uint32_t nearer_pixels(std::uint32_t pixels, float first, float per_px, DepthRule rule, float* depth) {
    const Depths real;
    std::uint32_t nearer = 0;
    for (std::size_t i = 0; i < strip_px && pixels >> i != 0; i += hn::Lanes(real)) {
        std::array<std::uint8_t, 8> bits{};
        const std::uint32_t some = pixels >> i;
        std::memcpy(bits.data(), &some, sizeof some);
        const auto is_drawn = hn::LoadMaskBits(real, bits.data());
        const auto steps = lane_indices_from(real, i);
        const auto here = hn::Add(hn::Set(real, first), hn::Mul(steps, hn::Set(real, per_px)));
        const auto before = hn::LoadU(real, depth + i);
        const auto is_nearer = rule.passes_equal ? hn::Ge(here, before) : hn::Gt(here, before);
        const auto passes = hn::And(is_drawn, is_nearer);
        if (rule.writes) { hn::StoreU(hn::IfThenElse(passes, here, before), real, depth + i); }
        bits.fill(0);
        hn::StoreMaskBits(real, passes, bits.data());
        nearer |= static_cast<std::uint32_t>(bits[0] | bits[1] << 8) << i;
    }
    return nearer;
}

/// Colours pixels of a strip, a bit each, over the colours that they have.
HWY_INLINE void colour_over(
    std::uint32_t pixels, const std::array<StripGradient, 3>& gradients, std::size_t first, TileBuffer& buffer) {
    alignas(8) std::array<std::uint8_t, 8> bits{};
    std::memcpy(bits.data(), &pixels, sizeof pixels);
    for (std::size_t i = 0; i < strip_parts; ++i) {
        const std::size_t at = first + i * part_px;
        const auto is_drawn = hn::LoadMaskBits(Strip(), bits.data() + i * part_px / 8);
        const auto put = [&](hn::Vec<Strip> value, std::uint16_t* to) HWY_ATTR {
            hn::StoreU(hn::IfThenElse(is_drawn, value, hn::LoadU(Strip(), to)), Strip(), to);
        };
        put(hn::Set(Strip(), 0xffff), buffer.covered.data() + at);
        for (std::size_t k = 0; k < 3; ++k) {
            put(hn::ShiftLeft<4>(gradients[k].colour(i)), buffer.sums[k].data() + at);
        }
    }
}

/// Writes the detail texture of a triangle to pixels of a strip, a bit each; nothing for a triangle without one. The
/// strip begins at a column and row of the tile.
HWY_INLINE void add_detail_over(
    std::uint32_t pixels, const Triangle& triangle, const TileJob& job, const glm::ivec2& at, TileBuffer& buffer) {
    const auto first = static_cast<std::size_t>(at.y * tile_width + at.x);
    alignas(8) std::array<std::uint8_t, 8> bits{};
    std::memcpy(bits.data(), &pixels, sizeof pixels);
    for (std::size_t i = 0; i < strip_parts; ++i) {
        const std::size_t part = i * part_px;
        const auto is_drawn = hn::LoadMaskBits(Strip(), bits.data() + part / 8);
        const auto count = hn::Set(Strip(), triangle.has_detail_texture ? std::uint16_t{0} : std::uint16_t{16});
        std::uint16_t* const sums = buffer.sums[3].data() + first + part;
        hn::StoreU(hn::IfThenElse(is_drawn, count, hn::LoadU(Strip(), sums)), Strip(), sums);
        if (triangle.has_detail_texture) {
            put_ground(Strip(), triangle, job, at + glm::ivec2(static_cast<int>(part), 0),
                hn::VecFromMask(Strip(), is_drawn), buffer);
        }
    }
    for (std::uint32_t left = triangle.has_detail_texture || at.y % 2 != 0 ? 0 : pixels; left != 0; left &= left - 1) {
        const int column = at.x + std::countr_zero(left);
        if (column % 2 == 0) { buffer.ground_of_row(at.y)[column / 2] = 0; }
    }
}

/// As paint_strip_of_middles(), over what is there, by depth where the triangle has one.
HWY_INLINE void paint_strip_over(
    const TileTriangle& one, const TileJob& job, const TileBox& box, int left, TileBuffer& buffer) {
    const Triangle& triangle = *one.triangle;
    const std::uint32_t columns = box.columns_of_strip(left);
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    const glm::ivec2 box_px = job.first_px + glm::ivec2(box.left, box.first_row);
    MiddleEdge whole(triangle.whole, triangle.top, first_px);
    MiddleEdge upper(triangle.upper, triangle.top, first_px);
    MiddleEdge lower(triangle.lower, triangle.middle, first_px);
    const std::uint32_t bends_left = triangle.middle_is_left ? ~0U : 0U;
    const int first_lower = first_row_of(triangle.middle) - job.first_px.y;
    const DepthRule rule(triangle.depth);
    auto gradients = strip_gradients(triangle.gradients, box_px, left - box.left);
    auto pixel = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (int row = box.first_row; row <= box.last_row; ++row, pixel += tile_width) {
        const std::uint32_t bent = (row < first_lower ? upper : lower).pixels_from();
        const std::uint32_t through = whole.pixels_from();
        std::uint32_t drawn = (bent ^ through) & (through ^ (bends_left & (bent ^ through))) & columns;
        if (drawn != 0 && rule.compares) {
            const auto share = static_cast<double>(one.extra->depth_share);
            const AttributePlane& plane = one.extra->depth;
            drawn =
                nearer_pixels(drawn, static_cast<float>(plane.at(job.first_px.x + left, job.first_px.y + row) * share),
                    static_cast<float>(plane.per_x * share), rule, buffer.depth.data() + pixel);
        }
        if (drawn != 0 && rule.colours) {
            colour_over(drawn, gradients, pixel, buffer);
            if (job.detail_texture != nullptr) { add_detail_over(drawn, triangle, job, {left, row}, buffer); }
        }
        whole.x += whole.slope;
        upper.x += upper.slope;
        lower.x += lower.slope;
        for (StripGradient& level : gradients) { level.at += level.per_row; }
    }
}

/// The same for any triangle, pixel by pixel.
HWY_INLINE void paint_pixels_over(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    cover(one, job, lanes, buffer);
    const DepthRule rule(one.triangle->depth);
    const auto put = [&](std::size_t pixel, const PixelColour& colour) HWY_ATTR {
        buffer.covered[pixel] = 0xffff;
        for (std::size_t k = 0; k < 3; ++k) { buffer.sums[k][pixel] = static_cast<std::uint16_t>(colour[k] * 16U); }
    };
    buffer.fragments.count = 0;
    for_each_covered(job, buffer, [&](const glm::ivec2& in_tile, std::size_t pixel, std::uint32_t /*mask*/) HWY_ATTR {
        const glm::ivec2 at = job.first_px + in_tile;
        if (rule.compares) {
            const auto here =
                static_cast<float>(one.extra->depth.at(at.x, at.y) * static_cast<double>(one.extra->depth_share));
            float& before = buffer.depth[pixel];
            if (!(here > before || (rule.passes_equal && here == before))) { return; }
            before = rule.writes ? here : before;
        }
        if (!rule.colours) { return; }
        if (one.surface != nullptr) {
            buffer.fragments.add(pixel, 0xffff);
        } else {
            put(pixel, colour_of(one, job, at.x, at.y));
        }
        if (job.detail_texture != nullptr) {
            const Triangle& triangle = *one.triangle;
            buffer.sums[3][pixel] = triangle.has_detail_texture ? 0 : 16;
            if (in_tile.x % 2 == 0 && in_tile.y % 2 == 0) {
                buffer.ground_of_row(in_tile.y)[in_tile.x / 2] =
                    triangle.has_detail_texture ? ground_at(triangle, at.x, at.y) : 0;
            }
        }
    });
    if (one.surface == nullptr) { return; }
    for_each_fragment(one, job, buffer.fragments,
        [&](std::size_t pixel, std::uint32_t /*samples*/, const PixelColour& colour, std::uint32_t /*alpha*/)
            HWY_ATTR { put(pixel, colour); });
}

/// Whether a tile is painted far to near: each triangle paints over those before it. So it is where the job says so,
/// and where all triangles belong to one depth group; never with transparent surfaces, which are recorded separately.
HWY_INLINE bool is_far_to_near(const TileJob& job, const SampleLanes& lanes) {
    if (!lanes.is_single_sample || job.triangles.empty()) { return false; }
    const std::uint16_t first = job.triangles.front().triangle->group;
    const bool one_group = first != 0 && first == job.triangles.back().triangle->group;
    const auto is_recorded_separately = [](const TileTriangle& one) HWY_ATTR {
        return is_transparent_surface(one) || is_transparent_fill(one);
    };
    return (job.far_to_near || one_group) && std::ranges::none_of(job.triangles, is_recorded_separately);
}

/// Paints all triangles of a tile, each over those before it.
HWY_NOINLINE void paint_far_to_near(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    std::uint16_t group = 0;
    for (const TileTriangle& one : job.triangles) {
        const Triangle& triangle = *one.triangle;
        if (triangle.group != 0 && triangle.group != group) {
            group = triangle.group;
            buffer.depth.assign(TileBuffer::pixels + TileBuffer::padding, 0.0F);
        }
        const bool is_plain = one.surface == nullptr && triangle.fill == Fill::Gouraud &&
                              (one.extra == nullptr || one.extra->cut_count == 0);
        if (!is_plain) {
            paint_pixels_over(one, job, lanes, buffer);
            continue;
        }
        const TileBox box(triangle, job);
        for (int left = box.left; left <= box.right; left += strip_px) {
            paint_strip_over(one, job, box, left, buffer);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
