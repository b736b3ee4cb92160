// Two rows of a triangle at once, where a register holds 32 pixels: sixteen of a row and sixteen of the next, which
// begin where the triangle does. What comes out is the same as row by row. Included once for each instruction set.
#if defined(OCTANT_RASTER_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_ROWS_INL
#undef OCTANT_RASTER_ROWS_INL
#else
#define OCTANT_RASTER_ROWS_INL
#endif

#include "visuals/raster/row_pair_window-inl.h"
#include "visuals/raster/strip_gradient-inl.h"
#include "visuals/raster/tile_inverse_depth-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// The samples of a triangle, two rows at a time; as StripCoverage.
class PairCoverage {
public:
    HWY_INLINE PairCoverage(const Triangle& triangle, const TileJob& job, const TileBox& box, const SampleLanes& lanes)
        : PairCoverage(triangle, job.first_px + glm::ivec2(box.left, box.first_row), lanes) {}

    HWY_INLINE hn::Vec<Strip> samples(const PairWindow& window) const {
        const PairBits bits;
        const auto is_before = [&](hn::Vec<PairLanes> y) HWY_ATTR { return hn::Lt(y_, y); };
        const auto columns = [&](const StripEdge& edge) HWY_ATTR { return columns_of(edge); };
        const auto bent = pixels_from(hn::IfThenElse(is_before(middle_), columns(upper_), columns(lower_)));
        const auto whole = pixels_from(columns(whole_));
        const auto bends_left = hn::Set(bits, bends_left_ ? std::uint16_t{0xffff} : std::uint16_t{0});
        const auto between = hn::And(hn::Xor(bent, whole), hn::Xor(whole, hn::And(bends_left, hn::Xor(bent, whole))));
        const auto in_height = hn::RebindMask(bits, hn::AndNot(is_before(top_), is_before(bottom_)));
        const auto counting = hn::BitCast(bits, hn::Set(LaneBits(), window.columns));
        const auto masks = hn::IfThenElseZero(in_height, hn::And(between, counting));
        return samples_of_pixels(LaneMasks{hn::BitCast(LaneBits(), masks)})[0];
    }

    HWY_INLINE void next_rows() {
        for (StripEdge* edge : {&whole_, &upper_, &lower_}) { edge->x += 2 * edge->slope; }
        y_ = hn::Add(y_, hn::Set(PairLanes(), 512));
    }

private:
    HWY_INLINE
    PairCoverage(const Triangle& triangle, const glm::ivec2& first_px, const SampleLanes& lanes)
        : down_(load_lanes(lanes.down.data())), round_up_(load_lanes(lanes.round_up.data())),
          whole_(triangle.whole, triangle.top, first_px, down_, round_up_),
          upper_(triangle.upper, triangle.top, first_px, down_, round_up_),
          lower_(triangle.lower, triangle.middle, first_px, down_, round_up_), bends_left_(triangle.middle_is_left),
          top_(place(triangle.top - first_px.y * 256)), middle_(place(triangle.middle - first_px.y * 256)),
          bottom_(place(triangle.bottom - first_px.y * 256)) {
        const auto first = hn::BitCast(LaneBits(), hn::ShiftLeft<3>(down_[0]));
        const auto second = hn::Add(first, hn::Set(LaneBits(), 256U));
        y_ = hn::BitCast(PairLanes(), in_turn(first, hn::ShiftLeft<16>(second)));
    }

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
        return hn::BitCast(PairLanes(), in_turn(hn::ShiftRight<16>(at(edge.x)), at(edge.x + edge.slope)));
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
    StripEdge whole_;      ///< from the tile's first column
    StripEdge upper_;
    StripEdge lower_;
    bool bends_left_;
    hn::Vec<PairLanes> top_; ///< as y_
    hn::Vec<PairLanes> middle_;
    hn::Vec<PairLanes> bottom_;
};

/// A level over two rows, as StripGradient.
struct PairGradient {
    std::uint32_t at; ///< of the upper row's first column in the box, 2^-16 level
    std::uint32_t per_row;
    hn::Vec<StripSigned> least;
    hn::Vec<StripSigned> most;
    hn::Vec<StripSigned> steps;

    HWY_INLINE
    PairGradient(const ColourGradients& gradients, std::size_t k, const TileJob& job, const TileBox& box)
        : at(first_level(gradients, k, job.first_px + glm::ivec2(box.left, box.first_row))),
          per_row(static_cast<std::uint32_t>(gradients.per_y[k])), least(hn::Set(StripSigned(), gradients.least[k])),
          most(hn::Set(StripSigned(), gradients.most[k])) {
        const StripSigned sign;
        const auto columns = hn::And(lane_indices_from(sign, 0), hn::Set(sign, window_px - 1));
        steps = hn::Mul(columns, hn::Set(sign, gradients.per_column[k]));
    }

    /// 1/128 level from the level 128.
    HWY_INLINE hn::Vec<StripSigned> level() const {
        const hn::Half<StripSigned> row;
        const auto first = [&](std::uint32_t of_row) HWY_ATTR {
            return hn::Set(row, static_cast<std::int16_t>(static_cast<std::int32_t>(of_row) >> 9));
        };
        const auto both = hn::Combine(StripSigned(), first(at + per_row), first(at));
        return hn::Min(hn::Max(hn::Add(both, steps), least), most);
    }

    HWY_INLINE void next_rows() { at += 2 * per_row; }
};

/// The levels of a triangle over two rows.
HWY_INLINE std::array<PairGradient, 3> pair_gradients(
    const ColourGradients& gradients, const TileJob& job, const TileBox& box) {
    const auto level = [&](std::size_t k) HWY_ATTR { return PairGradient(gradients, k, job, box); };
    return {level(0), level(1), level(2)};
}

/// The ground in the columns of a box that is as narrow as a window.
template <PaintAs kind>
HWY_INLINE auto ground_of_box(const Triangle& triangle, const TileJob& job, const TileBox& box) {
    if constexpr (kind == PaintAs::Ground) {
        return GroundOfColumns<RowLanes>(triangle, job, box.left);
    } else {
        return 0;
    }
}

/// Covers what is free of a triangle whose box is as narrow as a window, and calls paint(window, fresh samples of its
/// pixels) for all its windows and next_rows() after two rows.
template <class Paint, class NextRows>
HWY_INLINE void paint_in_pairs(PairCoverage& coverage, const TileJob& job, const TileBox& box, TileBuffer& buffer,
    const Paint& paint, const NextRows& next_rows) {
    const std::uint64_t full_row = job.full_row();
    for (int row = box.first_row; row <= box.last_row; row += 2) {
        std::uint64_t* const full = buffer.full.data() + row;
        const PairWindow window(box, row);
        if (window.has_free(full)) {
            const auto masks = coverage.samples(window);
            const auto before = window.load(buffer.covered.data());
            const auto after = hn::Or(before, masks);
            window.store(after, buffer.covered.data());
            paint(window, hn::AndNot(before, masks));
            const std::uint32_t bits = full_bits(StripValues{after});
            full[0] |= std::uint64_t{bits & 0xffffU} << window.left;
            full[1] |= std::uint64_t{bits >> 16U} << window.left;
        }
        const std::uint64_t is_full =
            std::uint64_t{(full[0] & full_row) == full_row} | std::uint64_t{(full[1] & full_row) == full_row} << 1U;
        buffer.full_rows |= static_cast<std::uint32_t>(is_full << row);
        coverage.next_rows();
        next_rows();
    }
}

/// Paints a triangle of levels that is as narrow as a window; of ground its box begins in an even row and column.
template <PaintAs kind>
HWY_INLINE void paint_gouraud_in_pairs(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, const TileBox& box, TileBuffer& buffer) {
    PairCoverage coverage(triangle, job, box, lanes);
    auto gradients = pair_gradients(triangle.gradients, job, box);
    [[maybe_unused]] const auto ground = ground_of_box<kind>(triangle, job, box);
    const auto paint = [&](const PairWindow& window, hn::Vec<Strip> fresh) HWY_ATTR {
        const auto counts = hn::PopulationCount(fresh);
        for (std::size_t k = 0; k < gradients.size(); ++k) {
            std::uint16_t* const sums = buffer.sums[k].data();
            const auto colour = from_level(gradients[k].level());
            window.store(hn::Add(window.load(sums), hn::Mul(colour, counts)), sums);
        }
        if constexpr (kind == PaintAs::Ground) {
            ground.put(window.row, hn::LowerHalf(RowLanes(), fresh), buffer);
        } else if constexpr (kind == PaintAs::Beside) {
            std::uint16_t* const other_than_ground = buffer.sums[3].data();
            window.store(hn::Add(window.load(other_than_ground), counts), other_than_ground);
        }
    };
    paint_in_pairs(coverage, job, box, buffer, paint, [&]() HWY_ATTR {
        for (PairGradient& level : gradients) { level.next_rows(); }
    });
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
