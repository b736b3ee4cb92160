// Which samples of a tile a triangle covers: a mask of sixteen bits for each pixel. Included once for each instruction
// set.
#if defined(OCTANT_RASTER_COVERAGE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_COVERAGE_INL
#undef OCTANT_RASTER_COVERAGE_INL
#else
#define OCTANT_RASTER_COVERAGE_INL
#endif

#include "visuals/raster/lane_indices-inl.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::FixedTag<std::uint8_t, 16>; ///< a lane for each sample

/// Where the lanes of a row cross an edge, less where the row's middle does, with what rounds a crossing up to a
/// column: 2^-16 pixel. The same in all rows.
template <class Words, std::size_t registers = SamplePattern::lanes / hn::MaxLanes(Words())>
struct LaneOffsets;

template <class Words>
struct LaneOffsets<Words, 2> {
    hn::Vec<Words> first, second;

    HWY_INLINE LaneOffsets(std::int32_t slope_32nd, const SampleLanes& lanes) {
        // Packing takes four lanes from each in turn.
        const Words words;
        const auto offsets = [&](std::size_t from) HWY_ATTR {
            const hn::Half<Words> half;
            const auto spread = [&](const std::int32_t* table) HWY_ATTR {
                return hn::Combine(words, hn::Load(half, table + from + 8), hn::Load(half, table + from));
            };
            return hn::Add(
                hn::Mul(spread(lanes.down.data()), hn::Set(words, slope_32nd)), spread(lanes.round_up.data()));
        };
        first = offsets(0);
        second = offsets(4);
    }

    /// The first column whose sample does not lie left of the edge, 0..255, for each lane.
    HWY_INLINE hn::Vec<Bytes> columns(std::int32_t x) const {
        const Words words;
        const auto middle = hn::Set(words, x);
        return hn::DemoteTo(
            Bytes(), hn::ReorderDemote2To(hn::Repartition<std::int16_t, Words>(),
                         hn::ShiftRight<16>(hn::Add(middle, first)), hn::ShiftRight<16>(hn::Add(middle, second))));
    }
};

template <class Words>
struct LaneOffsets<Words, 4> {
    hn::Vec<Words> first, second, third, fourth;

    HWY_INLINE LaneOffsets(std::int32_t slope_32nd, const SampleLanes& lanes) {
        const Words words;
        const auto offsets = [&](std::size_t from) HWY_ATTR {
            return hn::Add(hn::Mul(hn::Load(words, lanes.down.data() + from), hn::Set(words, slope_32nd)),
                hn::Load(words, lanes.round_up.data() + from));
        };
        first = offsets(0);
        second = offsets(4);
        third = offsets(8);
        fourth = offsets(12);
    }

    HWY_INLINE hn::Vec<Bytes> columns(std::int32_t x) const {
        const hn::Repartition<std::int16_t, Words> shorts;
        const hn::FixedTag<std::uint8_t, 8> half;
        const auto middle = hn::Set(Words(), x);
        const auto at = [&](hn::Vec<Words> offset) HWY_ATTR { return hn::ShiftRight<16>(hn::Add(middle, offset)); };
        const auto low = hn::ReorderDemote2To(shorts, at(first), at(second));
        const auto high = hn::ReorderDemote2To(shorts, at(third), at(fourth));
        return hn::Combine(Bytes(), hn::DemoteTo(half, high), hn::DemoteTo(half, low));
    }
};

/// An edge in a tile, row by row.
struct EdgeStepper {
    std::int64_t x;     ///< at the middle of the tile's first row, from its first column, 2^-32 pixel
    std::int64_t slope; ///< x a row
    LaneOffsets<hn::CappedTag<std::int32_t, 8>> offsets;

    /// `top`: of the edge, 1/256 pixel.
    HWY_INLINE EdgeStepper(const Edge& edge, std::int32_t top, const glm::ivec2& tile_px, const SampleLanes& lanes)
        : slope(edge.slope), offsets(static_cast<std::int32_t>(edge.slope >> 21), lanes) {
        // Less than the least distance of a crossing from a column's middle where it is not on it.
        constexpr std::uint64_t on_it = std::uint64_t{1} << 10;
        const auto rows = static_cast<std::uint64_t>(std::int64_t{tile_px.y - first_row_of(top)});
        x = static_cast<std::int64_t>(static_cast<std::uint64_t>(edge.x) + static_cast<std::uint64_t>(slope) * rows -
                                      (static_cast<std::uint64_t>(std::int64_t{tile_px.x}) << 32) - on_it);
    }

    HWY_INLINE std::int64_t at(int row) const {
        return static_cast<std::int64_t>(
            static_cast<std::uint64_t>(x) +
            static_cast<std::uint64_t>(slope) * static_cast<std::uint64_t>(std::int64_t{row}));
    }

    HWY_INLINE hn::Vec<Bytes> columns(int row) const {
        return offsets.columns(static_cast<std::int32_t>(at(row) >> 16));
    }
};

/// Bounds the columns of each lane by a line, too.
HWY_INLINE void bound_by(const ClipLine& line, const SampleLanes& lanes, const glm::ivec2& tile_px, std::int32_t row,
    hn::Vec<Bytes>& least, hn::Vec<Bytes>& end) {
    alignas(16) std::array<std::uint8_t, 16> line_min{};
    alignas(16) std::array<std::uint8_t, 16> line_end{};
    const double at_tile = line.c + line.a * tile_px.x + line.b * row;
    for (std::size_t lane = 0; lane < 16; ++lane) {
        const double here =
            at_tile + line.b * static_cast<double>(lanes.y_px[lane]) + line.a * static_cast<double>(lanes.x_px[lane]);
        line_end[lane] = tile_width;
        if (line.a == 0.0) {
            line_end[lane] = here >= 0.0 ? tile_width : 0;
            continue;
        }
        const double at = std::clamp(-here / line.a, -1.0, 1.0 + tile_width);
        if (line.a > 0.0) {
            line_min[lane] = static_cast<std::uint8_t>(std::max(std::ceil(at), 0.0));
        } else {
            line_end[lane] = static_cast<std::uint8_t>(std::clamp(std::floor(at) + 1.0, 0.0, 1.0 * tile_width));
        }
    }
    least = hn::Max(least, hn::Load(Bytes(), line_min.data()));
    end = hn::Min(end, hn::Load(Bytes(), line_end.data()));
}

/// Columns of a row.
struct RowSpan {
    int first; ///< that may be covered
    int last;
    int whole; ///< from here to `whole_end` - 1 all samples are
    int whole_end;
};

/// Narrows a row to the columns that two edges cross or enclose, both of which go through the whole row.
HWY_INLINE void narrow(const EdgeStepper& left, const EdgeStepper& right, int row, RowSpan& span) {
    constexpr std::int64_t half_px = std::int64_t{1} << 31;
    const std::int64_t left_reach = std::abs(left.slope) / 2 + half_px;
    const std::int64_t right_reach = std::abs(right.slope) / 2 + half_px;
    const std::int64_t left_x = left.at(row);
    const std::int64_t right_x = right.at(row);
    const auto column = [](std::int64_t x) {
        return static_cast<int>(std::clamp<std::int64_t>(x >> 32, -1, tile_width));
    };
    span.first = std::max(span.first, column(left_x - left_reach));
    span.last = std::min(span.last, column(right_x + right_reach) + 1);
    span.whole = std::max(span.first, column(left_x + left_reach) + 1);
    span.whole_end = std::min(span.last + 1, column(right_x - right_reach));
}

/// Sixteen bytes as often as they fit.
template <class Wide>
HWY_INLINE hn::Vec<Wide> repeated(Wide wide, hn::Vec<Bytes> bytes) {
    if constexpr (hn::MaxLanes(Wide()) == 16) {
        return bytes;
    } else {
        const hn::Half<Wide> half;
        const auto once = repeated(half, bytes);
        return hn::Combine(wide, once, once);
    }
}

/// Writes the masks of a row's blocks. Those within `span.whole` .. `whole_end` - 1 are known.
HWY_INLINE void write_masks(
    hn::Vec<Bytes> least, hn::Vec<Bytes> end, const RowSpan& span, int blocks, std::uint16_t* masks) {
    const hn::CappedTag<std::uint8_t, 64> wide;
    const hn::RebindToSigned<decltype(wide)> sign;
    constexpr std::size_t at_once = hn::MaxLanes(wide) / SamplePattern::lanes;
    // Compared as signed numbers, both less 128.
    const auto half = hn::Set(Bytes(), 128);
    const auto from_all = repeated(wide, hn::Add(least, half));
    const auto count_all = hn::BitCast(sign, repeated(wide, hn::Sub(hn::SaturatedSub(end, least), half)));
    const auto pixels = hn::ShiftRight<4>(lane_indices_from(wide, 0));
    for (int block = 0; block < blocks; ++block) {
        const int first = span.first + 16 * block;
        std::uint16_t* const to = masks + 16 * block;
        if (first >= span.whole && first + 16 <= span.whole_end) {
            const hn::CappedTag<std::uint16_t, 16> px;
            for (std::size_t i = 0; i < 16; i += hn::Lanes(px)) { hn::StoreU(hn::Set(px, 0xffff), px, to + i); }
            continue;
        }
        const auto column = hn::Add(hn::Set(wide, static_cast<std::uint8_t>(first)), pixels);
        const auto from_first = hn::Sub(column, from_all);
        HWY_UNROLL(8)
        for (std::size_t i = 0; i < 16; i += at_once) {
            const auto at = hn::Add(from_first, hn::Set(wide, static_cast<std::uint8_t>(i)));
            const auto covers = hn::Lt(hn::BitCast(sign, at), count_all);
            hn::StoreMaskBits(sign, covers, reinterpret_cast<std::uint8_t*>(to + i));
        }
    }
}

/// How many lanes of a row lie above a place, 1/256 pixel.
HWY_INLINE int lanes_above(std::int32_t y, std::int32_t row, const SampleLanes& lanes) {
    const std::int32_t place = std::clamp(y - row * 256, -128, 128);
    return lanes.lanes_above[static_cast<std::size_t>(place + 128)];
}

/// Writes the masks of the samples that a triangle covers into TileBuffer::masks, for rows that are not covered whole
/// by nearer ones.
HWY_NOINLINE void cover(const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const Triangle& triangle = *one.triangle;
    const EdgeStepper whole(triangle.whole, triangle.top, job.first_px, lanes);
    const EdgeStepper upper(triangle.upper, triangle.top, job.first_px, lanes);
    const EdgeStepper lower(triangle.lower, triangle.middle, job.first_px, lanes);
    const bool bends_left = triangle.middle_is_left;
    const std::int32_t tile_row = job.first_px.y;
    Coverage& coverage = buffer.coverage;
    coverage.first_row = std::max(triangle.first_row - tile_row, 0);
    coverage.last_row = std::min(triangle.last_row - tile_row, job.size_px.y - 1);
    const int left = std::max(triangle.left - job.first_px.x, 0);
    const int right = std::min(triangle.right - job.first_px.x, job.size_px.x - 1);
    const auto rows_of_it =
        static_cast<std::uint32_t>((std::uint64_t{2} << coverage.last_row) - (std::uint64_t{1} << coverage.first_row));
    if ((rows_of_it & ~buffer.full_rows) == 0) {
        coverage.last_row = -1;
        return;
    }
    const bool is_cut = one.extra != nullptr && one.extra->cut_count > 0;
    for (int at = coverage.first_row; at <= coverage.last_row; ++at) {
        Coverage::Row& places = coverage.rows[static_cast<std::size_t>(at)];
        places.blocks = 0;
        const std::int32_t row = tile_row + at;
        const std::int32_t above = row * 256 - 128;
        const std::int32_t below = row * 256 + 128;
        const bool is_upper = below <= triangle.middle;
        const bool is_through =
            above >= triangle.top && below <= triangle.bottom && (is_upper || above >= triangle.middle);
        const EdgeStepper& bent = is_upper ? upper : lower;
        RowSpan span{left, right, tile_width, 0};
        if (is_through) {
            narrow(bends_left ? bent : whole, bends_left ? whole : bent, at, span);
            if (span.first > span.last) { continue; }
        }
        const std::uint64_t columns = (~std::uint64_t{0} << span.first) & (~std::uint64_t{0} >> (63 - span.last));
        if ((columns & ~buffer.full[static_cast<std::size_t>(at)]) == 0) { continue; }
        places.first = span.first;
        places.last = span.last;
        places.blocks = (span.last - span.first) / 16 + 1;
        auto bent_columns = bent.columns(at);
        const auto whole_columns = whole.columns(at);
        auto within = hn::Set(Bytes(), tile_width);
        if (!is_through) {
            const auto lane = lane_indices_from(Bytes(), 0);
            const auto is_before = [&](std::int32_t y) HWY_ATTR {
                return hn::Lt(lane, hn::Set(Bytes(), static_cast<std::uint8_t>(lanes_above(y, row, lanes))));
            };
            bent_columns = hn::IfThenElse(is_before(triangle.middle), upper.columns(at), lower.columns(at));
            within = hn::IfThenElseZero(hn::AndNot(is_before(triangle.top), is_before(triangle.bottom)), within);
        }
        auto least = bends_left ? bent_columns : whole_columns;
        auto end = hn::Min(bends_left ? whole_columns : bent_columns, within);
        if (is_cut) {
            for (int k = 0; k < one.extra->cut_count; ++k) {
                bound_by(one.extra->cuts[static_cast<std::size_t>(k)], lanes, job.first_px, row, least, end);
            }
        }
        if (is_cut) { span.whole_end = 0; }
        write_masks(least, end, span, places.blocks,
            buffer.masks.data() + static_cast<std::size_t>(at) * TileBuffer::mask_row +
                static_cast<std::size_t>(span.first));
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
