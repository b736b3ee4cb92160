// Paints a triangle whose colour is planes of levels: masks and colours of 32 pixels at once, with
// as few choices on the way as can be. Nearly all triangles are of this kind, and small.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_LEVELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_LEVELS_INL
#undef OCTANT_RASTER_LEVELS_INL
#else
#define OCTANT_RASTER_LEVELS_INL
#endif

#include "visuals/raster/tile_strip-inl.h"

#include <algorithm>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using StripSigned = hn::RebindToSigned<Strip>;
constexpr std::size_t part_px = hn::MaxLanes(Strip());

/// The part of a tile in which a triangle may cover something.
struct TileBox {
    int left;
    int right;
    int first_row;
    int last_row;

    HWY_INLINE TileBox(const Triangle& triangle, const TileJob& job)
        : left(std::max(triangle.left - job.first_px.x, 0))
        , right(std::min(triangle.right - job.first_px.x, job.size_px.x - 1))
        , first_row(std::max(triangle.first_row - job.first_px.y, 0))
        , last_row(std::min(triangle.last_row - job.first_px.y, job.size_px.y - 1)) {}

    /// A bit for each column from `left_column` on that belongs to it.
    std::uint32_t columns_of_strip(int left_column) const {
        const int width = right - left_column + 1;
        return width >= strip_px ? ~0U : (1U << width) - 1U;
    }

    std::uint32_t rows() const {
        return static_cast<std::uint32_t>(
            (std::uint64_t{2} << last_row) - (std::uint64_t{1} << first_row));
    }
};

/// A level over a strip, row by row: 1/128 level from the level 128, wrapping.
struct StripLevel {
    std::uint32_t at; ///< of the strip's first column, 2^-16 level
    std::uint32_t per_row;
    hn::Vec<StripSigned> least;
    hn::Vec<StripSigned> most;
    std::array<hn::Vec<StripSigned>, strip_parts> steps;

    HWY_INLINE StripLevel(const Levels& levels, std::size_t k, const glm::ivec2& first_px)
        : at(static_cast<std::uint32_t>(levels.base[k]) + 256U +
             static_cast<std::uint32_t>(levels.per_x[k]) * static_cast<std::uint32_t>(first_px.x) +
             static_cast<std::uint32_t>(levels.per_y[k]) * static_cast<std::uint32_t>(first_px.y))
        , per_row(static_cast<std::uint32_t>(levels.per_y[k]))
        , least(hn::Set(StripSigned(), levels.least[k]))
        , most(hn::Set(StripSigned(), levels.most[k])) {
        const StripSigned sign;
        const auto per_column = hn::Set(sign, levels.per_column[k]);
        for (std::size_t i = 0; i < strip_parts; ++i) {
            steps[i] = hn::Mul(hn::Iota(sign, static_cast<std::int16_t>(i * part_px)), per_column);
        }
    }

    /// In 1/16 level from 0.
    HWY_INLINE hn::Vec<Strip> colour(std::size_t part) const {
        const StripSigned sign;
        const auto first = static_cast<std::int16_t>(static_cast<std::int32_t>(at) >> 9);
        const auto raw = hn::Add(hn::Set(sign, first), steps[part]);
        const auto level = hn::BitCast(Strip(), hn::Min(hn::Max(raw, least), most));
        return hn::ShiftRight<3>(hn::Add(level, hn::Set(Strip(), 128 * 128 + 4)));
    }
};

/// A bit for each pixel of a strip whose value has all bits set.
HWY_INLINE std::uint32_t full_bits(const StripValues& values) {
    alignas(8) std::array<std::uint8_t, 16> bytes;
    constexpr std::size_t bytes_a_part = part_px / 8;
    for (std::size_t i = 0; i < strip_parts; ++i) {
        hn::StoreMaskBits(
            Strip(), hn::Eq(values[i], hn::Set(Strip(), 0xffff)), bytes.data() + i * bytes_a_part);
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes.data(), sizeof bits);
    return bits;
}

/// Paints the strip of a triangle that begins at a column of the tile.
HWY_INLINE void paint_strip(
    const Triangle& triangle,
    const TileJob& job,
    const SampleLanes& lanes,
    const TileBox& box,
    int left,
    TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t wide_columns = std::uint64_t{columns} << left;
    const std::uint64_t full_row = job.full_row();
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    StripCoverage coverage(triangle, first_px, columns, lanes);
    std::array levels{
        StripLevel(triangle.levels, 0, first_px),
        StripLevel(triangle.levels, 1, first_px),
        StripLevel(triangle.levels, 2, first_px)};
    auto pixel = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (int row = box.first_row; row <= box.last_row; ++row, pixel += tile_width) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        if ((wide_columns & ~full) != 0) {
            const StripValues masks = coverage.samples();
            StripValues after;
            for (std::size_t i = 0; i < strip_parts; ++i) {
                const std::size_t at = pixel + i * part_px;
                const auto before = hn::LoadU(Strip(), buffer.covered.data() + at);
                const auto fresh = hn::AndNot(before, masks[i]);
                after[i] = hn::Or(before, masks[i]);
                hn::StoreU(after[i], Strip(), buffer.covered.data() + at);
                const auto counts = hn::PopulationCount(fresh);
                for (std::size_t k = 0; k < 3; ++k) {
                    std::uint16_t* const sums = buffer.sums[k].data() + at;
                    hn::StoreU(
                        hn::Add(hn::LoadU(Strip(), sums), hn::Mul(levels[k].colour(i), counts)),
                        Strip(),
                        sums);
                }
            }
            full |= std::uint64_t{full_bits(after)} << left;
            buffer.full_rows |= std::uint32_t{(full & full_row) == full_row} << row;
        }
        coverage.next_row();
        for (StripLevel& level : levels) {
            level.at += level.per_row;
        }
    }
}

/// An edge in a strip where a pixel's only sample is its middle.
struct MiddleEdge {
    std::uint64_t x; ///< as StripEdge
    std::uint64_t slope;

    HWY_INLINE MiddleEdge(const Edge& edge, std::int32_t top, const glm::ivec2& first_px)
        : x(strip_edge_x(edge, top, first_px))
        , slope(static_cast<std::uint64_t>(edge.slope)) {}

    /// The strip's pixels from the first on whose middle is not left of the edge.
    HWY_INLINE std::uint32_t pixels_from() const {
        const auto column = (static_cast<std::int32_t>(x >> 16) + 0xffff) >> 16;
        return static_cast<std::uint32_t>(~std::uint64_t{0} << std::clamp(column, 0, strip_px));
    }
};

/// paint_strip() where all lanes of a pixel share its middle: a triangle covers a pixel or does
/// not.
HWY_INLINE void paint_strip_of_middles(
    const Triangle& triangle,
    const TileJob& job,
    const TileBox& box,
    int left,
    TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t full_row = job.full_row();
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    MiddleEdge whole(triangle.whole, triangle.top, first_px);
    MiddleEdge upper(triangle.upper, triangle.top, first_px);
    MiddleEdge lower(triangle.lower, triangle.middle, first_px);
    const std::uint32_t bends_left = triangle.middle_is_left ? ~0U : 0U;
    const int first_lower = first_row_of(triangle.middle) - job.first_px.y;
    std::array levels{
        StripLevel(triangle.levels, 0, first_px),
        StripLevel(triangle.levels, 1, first_px),
        StripLevel(triangle.levels, 2, first_px)};
    auto pixel = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (int row = box.first_row; row <= box.last_row; ++row, pixel += tile_width) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        const std::uint32_t bent = (row < first_lower ? upper : lower).pixels_from();
        const std::uint32_t through = whole.pixels_from();
        const std::uint32_t between =
            (bent ^ through) & (through ^ (bends_left & (bent ^ through)));
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
                hn::StoreU(
                    hn::IfThenElse(is_fresh, all, hn::LoadU(Strip(), covered)), Strip(), covered);
                for (std::size_t k = 0; k < 3; ++k) {
                    std::uint16_t* const sums = buffer.sums[k].data() + at;
                    const auto sixteen = hn::ShiftLeft<4>(levels[k].colour(i));
                    hn::StoreU(
                        hn::IfThenElse(is_fresh, sixteen, hn::LoadU(Strip(), sums)), Strip(), sums);
                }
            }
        }
        whole.x += whole.slope;
        upper.x += upper.slope;
        lower.x += lower.slope;
        for (StripLevel& level : levels) {
            level.at += level.per_row;
        }
    }
}

/// Paints a triangle of Fill::Levels that no plane cuts.
HWY_NOINLINE void paint_levels(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) {
        return;
    }
    for (int left = box.left; left <= box.right; left += strip_px) {
        if (lanes.are_one) {
            paint_strip_of_middles(triangle, job, box, left, buffer);
        } else {
            paint_strip(triangle, job, lanes, box, left, buffer);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
