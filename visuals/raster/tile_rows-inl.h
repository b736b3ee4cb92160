// Paints two rows of a narrow triangle at once, where a register holds 32 pixels: sixteen of a row
// and sixteen of the next. What comes out is the same as row by row.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_ROWS_INL
#undef OCTANT_RASTER_ROWS_INL
#else
#define OCTANT_RASTER_ROWS_INL
#endif

#include "visuals/raster/strip_level-inl.h"

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

constexpr int narrow_px = strip_px / 2;
constexpr bool has_pairs_of_rows = strip_parts == 1;

/// For each sample of two rows, in turn: sixteen bits.
using PairLanes = hn::Repartition<std::int16_t, Lanes>;
using PairBits = hn::RebindToUnsigned<PairLanes>;
using Row = hn::Half<Strip>;

/// A value of each of two rows, next to each other.
HWY_INLINE hn::Vec<Strip> load_rows(const std::uint16_t* from) {
    return hn::Combine(Strip(), hn::LoadU(Row(), from + tile_width), hn::LoadU(Row(), from));
}

HWY_INLINE void store_rows(hn::Vec<Strip> values, std::uint16_t* to) {
    hn::StoreU(hn::LowerHalf(Row(), values), Row(), to);
    hn::StoreU(hn::UpperHalf(Row(), values), Row(), to + tile_width);
}

/// The samples of a narrow triangle, two rows at a time; as StripCoverage.
class PairCoverage {
public:
    /// Rows from `end_row` of the picture on have none.
    HWY_INLINE PairCoverage(
        const Triangle& triangle,
        const glm::ivec2& first_px,
        int end_row,
        std::uint32_t columns,
        const SampleLanes& lanes)
        : down_(load_lanes(lanes.down.data()))
        , round_up_(load_lanes(lanes.round_up.data()))
        , whole_(triangle.whole, triangle.top, first_px, down_, round_up_)
        , upper_(triangle.upper, triangle.top, first_px, down_, round_up_)
        , lower_(triangle.lower, triangle.middle, first_px, down_, round_up_)
        , columns_(hn::Set(PairBits(), static_cast<std::uint16_t>(columns)))
        , bends_left_(hn::Set(
              PairBits(), triangle.middle_is_left ? std::uint16_t{0xffff} : std::uint16_t{0}))
        , top_(place(triangle.top - first_px.y * 256))
        , middle_(place(triangle.middle - first_px.y * 256))
        , bottom_(place(std::min(triangle.bottom, end_row * 256 - 128) - first_px.y * 256)) {
        const auto first = hn::BitCast(LaneBits(), hn::ShiftLeft<3>(down_[0]));
        const auto second = hn::Add(first, hn::Set(LaneBits(), 256U));
        y_ = hn::BitCast(PairLanes(), in_turn(first, hn::ShiftLeft<16>(second)));
    }

    HWY_INLINE hn::Vec<Strip> samples() const {
        const PairBits bits;
        const auto is_before = [&](hn::Vec<PairLanes> y) HWY_ATTR { return hn::Lt(y_, y); };
        const auto bent =
            pixels_from(hn::IfThenElse(is_before(middle_), columns_of(upper_), columns_of(lower_)));
        const auto whole = pixels_from(columns_of(whole_));
        const auto between = hn::And(
            hn::Xor(bent, whole), hn::Xor(whole, hn::And(bends_left_, hn::Xor(bent, whole))));
        const auto in_height =
            hn::RebindMask(bits, hn::AndNot(is_before(top_), is_before(bottom_)));
        const auto masks = hn::IfThenElseZero(in_height, hn::And(between, columns_));
        return samples_of_pixels(LaneMasks{hn::BitCast(LaneBits(), masks)})[0];
    }

    HWY_INLINE void next_rows() {
        for (StripEdge* edge : {&whole_, &upper_, &lower_}) {
            edge->x += 2 * edge->slope;
        }
        y_ = hn::Add(y_, hn::Set(PairLanes(), 512));
    }

private:
    /// A row's place from the first, 1/256 pixel; what is far away stays beyond a tile.
    static HWY_INLINE hn::Vec<PairLanes> place(std::int32_t y) {
        return hn::Set(PairLanes(), static_cast<std::int16_t>(std::clamp(y, -16000, 16000)));
    }

    /// The lower halves of the first and the upper ones of the second.
    static HWY_INLINE hn::Vec<LaneBits> in_turn(hn::Vec<LaneBits> low, hn::Vec<LaneBits> high) {
        const auto lower_half = hn::Set(LaneBits(), 0xffffU);
        return hn::Or(hn::And(low, lower_half), hn::AndNot(lower_half, high));
    }

    /// StripEdge::column() of both rows.
    static HWY_INLINE hn::Vec<PairLanes> columns_of(const StripEdge& edge) {
        const auto at = [&](std::uint64_t x) HWY_ATTR {
            const auto middle = hn::Set(Lanes(), static_cast<std::int32_t>(x >> 16));
            return hn::BitCast(LaneBits(), hn::Add(middle, edge.offsets[0]));
        };
        return hn::BitCast(
            PairLanes(), in_turn(hn::ShiftRight<16>(at(edge.x)), at(edge.x + edge.slope)));
    }

    /// The row's pixels from a column on.
    static HWY_INLINE hn::Vec<PairBits> pixels_from(hn::Vec<PairLanes> column) {
        const PairBits bits;
        const auto from = hn::BitCast(bits, hn::Max(column, hn::Zero(PairLanes())));
        return hn::Shl(hn::Set(bits, 0xffff), from); // nothing is left where it is 16 or more
    }

    LaneValues down_;
    LaneValues round_up_;
    hn::Vec<PairLanes> y_; ///< of the samples, from the first row's middle, 1/256 pixel
    StripEdge whole_;
    StripEdge upper_;
    StripEdge lower_;
    hn::Vec<PairBits> columns_;
    hn::Vec<PairBits> bends_left_; ///< all bits or none
    hn::Vec<PairLanes> top_;       ///< as y_
    hn::Vec<PairLanes> middle_;
    hn::Vec<PairLanes> bottom_;
};

/// A level over two rows, as StripLevel.
struct PairLevel {
    std::uint32_t at; ///< of the first column of the upper row, 2^-16 level
    std::uint32_t per_row;
    hn::Vec<StripSigned> least;
    hn::Vec<StripSigned> most;
    hn::Vec<StripSigned> steps;

    HWY_INLINE PairLevel(const Levels& levels, std::size_t k, const glm::ivec2& first_px)
        : at(first_level(levels, k, first_px))
        , per_row(static_cast<std::uint32_t>(levels.per_y[k]))
        , least(hn::Set(StripSigned(), levels.least[k]))
        , most(hn::Set(StripSigned(), levels.most[k])) {
        const StripSigned sign;
        const auto columns = hn::And(hn::Iota(sign, 0), hn::Set(sign, narrow_px - 1));
        steps = hn::Mul(columns, hn::Set(sign, levels.per_column[k]));
    }

    /// In 1/16 level from 0.
    HWY_INLINE hn::Vec<Strip> colour() const {
        const hn::Half<StripSigned> row;
        const auto first = [&](std::uint32_t level) HWY_ATTR {
            return hn::Set(row, static_cast<std::int16_t>(static_cast<std::int32_t>(level) >> 9));
        };
        const auto raw = hn::Add(hn::Combine(StripSigned(), first(at + per_row), first(at)), steps);
        return from_level(hn::Min(hn::Max(raw, least), most));
    }
};

/// Paints a triangle of at most narrow_px columns.
HWY_INLINE void paint_narrow(
    const Triangle& triangle,
    const TileJob& job,
    const SampleLanes& lanes,
    const TileBox& box,
    TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(box.left);
    const std::uint64_t wide_columns = std::uint64_t{columns} << box.left;
    const std::uint64_t full_row = job.full_row();
    const glm::ivec2 first_px = job.first_px + glm::ivec2(box.left, box.first_row);
    PairCoverage coverage(triangle, first_px, job.first_px.y + box.last_row + 1, columns, lanes);
    std::array levels{
        PairLevel(triangle.levels, 0, first_px),
        PairLevel(triangle.levels, 1, first_px),
        PairLevel(triangle.levels, 2, first_px)};
    auto pixel = static_cast<std::size_t>(box.first_row * tile_width + box.left);
    for (int row = box.first_row; row <= box.last_row; row += 2, pixel += 2 * tile_width) {
        std::uint64_t* const full = buffer.full.data() + row;
        if ((wide_columns & ~(full[0] & full[1])) != 0) {
            std::uint16_t* const covered = buffer.covered.data() + pixel;
            const auto masks = coverage.samples();
            const auto before = load_rows(covered);
            const auto after = hn::Or(before, masks);
            const auto counts = hn::PopulationCount(hn::AndNot(before, masks));
            store_rows(after, covered);
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint16_t* const sums = buffer.sums[k].data() + pixel;
                store_rows(hn::Add(load_rows(sums), hn::Mul(levels[k].colour(), counts)), sums);
            }
            const std::uint32_t bits = full_bits({after});
            full[0] |= std::uint64_t{bits & 0xffffU} << box.left;
            full[1] |= std::uint64_t{bits >> 16U} << box.left;
            const std::uint64_t is_full = std::uint64_t{(full[0] & full_row) == full_row} |
                                          std::uint64_t{(full[1] & full_row) == full_row} << 1U;
            buffer.full_rows |= static_cast<std::uint32_t>(is_full << row);
        }
        coverage.next_rows();
        for (PairLevel& level : levels) {
            level.at += 2 * level.per_row;
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
