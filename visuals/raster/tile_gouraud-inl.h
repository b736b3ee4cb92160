// Paints a triangle whose colour is planes of levels: masks and colours of 32 pixels at once, with as few choices on
// the way as can be. Nearly all triangles are of this kind, and small. Included once for each instruction set.
#if defined(OCTANT_RASTER_LEVELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_LEVELS_INL
#undef OCTANT_RASTER_LEVELS_INL
#else
#define OCTANT_RASTER_LEVELS_INL
#endif

#include "visuals/raster/strip_gradient-inl.h"
#include "visuals/raster/strip_walk-inl.h"
#include "visuals/raster/tile_inverse_depth-inl.h"
#include "visuals/raster/tile_rows-inl.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// The ground in the parts of a strip that begins at a column of the tile.
template <PaintAs kind, std::size_t parts>
HWY_INLINE auto ground_of_parts(const Triangle& triangle, const TileJob& job, int left) {
    if constexpr (kind == PaintAs::Ground) {
        return [&]<std::size_t... part>(std::index_sequence<part...>) HWY_ATTR {
            return std::array{GroundOfColumns<Strip>(triangle, job, left + static_cast<int>(part * part_px))...};
        }
        (std::make_index_sequence<parts>());
    } else {
        return 0;
    }
}

/// Paints the strip of a triangle that begins at a column of the tile, or as many parts of it as have columns.
template <PaintAs kind, std::size_t parts>
HWY_INLINE void paint_strip(const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, const TileBox& box,
    int left, TileBuffer& buffer) {
    const glm::ivec2 box_px = job.first_px + glm::ivec2(box.left, box.first_row);
    auto gradients = strip_gradients(triangle.gradients, box_px, left - box.left);
    [[maybe_unused]] const auto ground = ground_of_parts<kind, parts>(triangle, job, left);
    using Values = PartValues<parts>;
    const auto paint = [&](int row, const Values& /*masks*/, const Values& fresh) HWY_ATTR {
        for (std::size_t i = 0; i < parts; ++i) {
            const auto at = static_cast<std::size_t>(row * tile_width + left) + i * part_px;
            const auto counts = hn::PopulationCount(fresh[i]);
            for (std::size_t k = 0; k < gradients.size(); ++k) {
                std::uint16_t* const sums = buffer.sums[k].data() + at;
                const auto colour = gradients[k].colour(i);
                const auto sum = hn::Add(hn::LoadU(Strip(), sums), hn::Mul(colour, counts));
                hn::StoreU(sum, Strip(), sums);
            }
            if constexpr (kind == PaintAs::Ground) {
                if (row % 2 == 0) { ground[i].put(row, fresh[i], buffer); }
            } else if constexpr (kind == PaintAs::Beside) {
                count_other_than_ground(Strip(), at, counts, buffer);
            }
        }
    };
    walk_strip<parts>(triangle, job, lanes, box, left, buffer, paint, [&]() HWY_ATTR {
        for (StripGradient& level : gradients) { level.at += level.per_row; }
    });
}

/// An edge in a strip where a pixel's only sample is its middle.
struct MiddleEdge {
    std::uint64_t x; ///< as StripEdge
    std::uint64_t slope;

    HWY_INLINE MiddleEdge(const Edge& edge, std::int32_t top, const glm::ivec2& first_px)
        : x(strip_edge_x(edge, top, first_px)), slope(static_cast<std::uint64_t>(edge.slope)) {}

    /// The strip's pixels from the first on whose middle is not left of the edge.
    HWY_INLINE std::uint32_t pixels_from() const {
        const auto column = (static_cast<std::int32_t>(x >> 16) + 0xffff) >> 16;
        return static_cast<std::uint32_t>(~std::uint64_t{0} << std::clamp(column, 0, strip_px));
    }
};

/// paint_strip() where all lanes of a pixel share its middle: a triangle covers a pixel or does not.
template <PaintAs kind>
HWY_INLINE void paint_strip_of_middles(
    const Triangle& triangle, const TileJob& job, const TileBox& box, int left, TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t full_row = job.full_row();
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    const glm::ivec2 box_px = job.first_px + glm::ivec2(box.left, box.first_row);
    MiddleEdge whole(triangle.whole, triangle.top, first_px);
    MiddleEdge upper(triangle.upper, triangle.top, first_px);
    MiddleEdge lower(triangle.lower, triangle.middle, first_px);
    const std::uint32_t bends_left = triangle.middle_is_left ? ~0U : 0U;
    const int first_lower = first_row_of(triangle.middle) - job.first_px.y;
    auto gradients = strip_gradients(triangle.gradients, box_px, left - box.left);
    auto pixel = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (int row = box.first_row; row <= box.last_row; ++row, pixel += tile_width) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        const std::uint32_t bent = (row < first_lower ? upper : lower).pixels_from();
        const std::uint32_t through = whole.pixels_from();
        const std::uint32_t between = (bent ^ through) & (through ^ (bends_left & (bent ^ through)));
        const std::uint32_t fresh = between & columns & ~static_cast<std::uint32_t>(full >> left);
        if (fresh != 0) {
            full |= std::uint64_t{fresh} << left;
            buffer.full_rows |= std::uint32_t{(full & full_row) == full_row} << row;
            alignas(8) std::array<std::uint8_t, 8> bits{};
            std::memcpy(bits.data(), &fresh, sizeof fresh);
            for (std::size_t i = 0; i < strip_parts; ++i) {
                const std::size_t at = pixel + i * part_px;
                const auto is_fresh = hn::LoadMaskBits(Strip(), bits.data() + i * part_px / 8);
                std::uint16_t* const covered = buffer.covered.data() + at;
                const auto all = hn::Set(Strip(), 0xffff);
                hn::StoreU(hn::IfThenElse(is_fresh, all, hn::LoadU(Strip(), covered)), Strip(), covered);
                for (std::size_t k = 0; k < gradients.size(); ++k) {
                    std::uint16_t* const sums = buffer.sums[k].data() + at;
                    const auto sixteen = hn::ShiftLeft<4>(gradients[k].colour(i));
                    hn::StoreU(hn::IfThenElse(is_fresh, sixteen, hn::LoadU(Strip(), sums)), Strip(), sums);
                }
                if constexpr (kind == PaintAs::Beside) {
                    const auto sixteen = hn::Set(Strip(), std::uint16_t{16});
                    count_other_than_ground(Strip(), at, hn::IfThenElseZero(is_fresh, sixteen), buffer);
                } else if constexpr (kind == PaintAs::Ground) {
                    const auto columns_right = static_cast<int>(i * part_px);
                    put_ground(Strip(), triangle, job, {left + columns_right, row}, hn::VecFromMask(Strip(), is_fresh),
                        buffer);
                }
            }
        }
        whole.x += whole.slope;
        upper.x += upper.slope;
        lower.x += lower.slope;
        for (StripGradient& level : gradients) { level.at += level.per_row; }
    }
}

/// Paints a triangle of Fill::Levels that no plane cuts.
template <PaintAs kind>
HWY_NOINLINE void paint_gouraud(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    TileBox box(triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) { return; }
    if constexpr (kind == PaintAs::Ground) {
        box.left &= ~1; // where the ground is noted
    }
    if constexpr (has_pairs_of_rows) {
        if (!lanes.are_one && box.right - box.left < window_px) {
            if constexpr (kind == PaintAs::Ground) { box.first_row &= ~1; }
            paint_gouraud_in_pairs<kind>(triangle, job, lanes, box, buffer);
            return;
        }
    }
    for (int left = box.left; left <= box.right; left += strip_px) {
        if (lanes.are_one) {
            paint_strip_of_middles<kind>(triangle, job, box, left, buffer);
            continue;
        }
        with_parts_of_strip(
            box, left, [&](auto parts) HWY_ATTR { paint_strip<kind, parts>(triangle, job, lanes, box, left, buffer); });
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
