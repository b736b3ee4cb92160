// The direction of descent is that of D. Tarboton, A new method for the determination of flow directions and upslope
// areas in grid DEMs, Water Resources Research 33(2), 1997 (facets). Deviations: water is not shared between the two
// neighbours of a facet but given to one of them, with the chance that leads in the facet's direction on average (after
// Fairfield and Leymarie's Rho8, 1991): streams do not run along the grid. Compiled once for each instruction set; all
// give the same bits.

#include "models/procedural/drainage.h"

// SVE's vectors have no size that the compiler knows.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "models/procedural/flow_direction.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

#include "models/procedural/lattice_hash-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <hwy/highway.h>
#include <limits>
#include <vector>

HWY_BEFORE_NAMESPACE();

namespace octant::models::procedural {
namespace HWY_NAMESPACE {

constexpr double diagonal = 1.4142135623730951;

/// A row and both its neighbours, with a cell more at either end and some more to read; NaN beyond the grid.
class ThreeRows {
public:
    HWY_INLINE ThreeRows(const TerrainGrid& ground, int row)
        : wide_(static_cast<std::size_t>(ground.side) + 2 + lane_count),
          values_(3 * wide_, std::numeric_limits<double>::quiet_NaN()) {
        for (int k = 0; k < 3; ++k) {
            const int from = row + k - 1;
            if (from >= 0 && from < ground.side) {
                std::copy_n(ground.values.begin() + static_cast<std::ptrdiff_t>(ground.index(0, from)), ground.side,
                    values_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(k) * wide_ + 1));
            }
        }
    }

    /// Of the cells so many columns and rows beside those from a column on.
    HWY_INLINE Real beside(std::size_t column, int dx, int dy) const {
        const std::size_t at = static_cast<std::size_t>(dy + 1) * wide_ + column + static_cast<std::size_t>(dx + 1);
        return hn::LoadU(Reals(), values_.data() + at);
    }

private:
    std::size_t wide_;
    std::vector<double> values_;
};

/// A facet is a triangle of a cell, a neighbour that shares a side with it and one at its corner.
struct Facet {
    Real to_side; ///< drops
    Real side_to_corner;
    Real side_step; ///< to the neighbours, in cells of the grid
    Real corner_step;

    /// The slope of the steepest descent within it, a cell; NaN where one of the drops is.
    HWY_INLINE Real slope() const {
        const Real between = hn::Sqrt(hn::Add(hn::Mul(to_side, to_side), hn::Mul(side_to_corner, side_to_corner)));
        const Real by_corner = hn::Div(hn::Add(to_side, side_to_corner), real(diagonal));
        const Real inner = hn::IfThenElse(hn::Ge(side_to_corner, to_side), by_corner, between);
        return hn::IfThenElse(hn::Le(side_to_corner, real(0.0)), to_side, inner);
    }

    /// Share of corner steps that leads in the direction of the steepest descent.
    HWY_INLINE Real corner_chance() const {
        const Real inner = hn::IfThenElse(hn::Ge(side_to_corner, to_side), real(1.0), hn::Div(side_to_corner, to_side));
        return hn::IfThenElse(hn::Le(side_to_corner, real(0.0)), real(0.0), inner);
    }

    HWY_INLINE void take_where(hn::Mask<Reals> mask, const Facet& other) {
        to_side = hn::IfThenElse(mask, other.to_side, to_side);
        side_to_corner = hn::IfThenElse(mask, other.side_to_corner, side_to_corner);
        side_step = hn::IfThenElse(mask, other.side_step, side_step);
        corner_step = hn::IfThenElse(mask, other.corner_step, corner_step);
    }
};

/// The facet of the steepest descent of cells, the first of equal ones; one without steps where nothing is lower.
HWY_INLINE Facet steepest_facet(const ThreeRows& rows, std::size_t column, int side) {
    struct Step {
        int dx;
        int dy;
    };

    // The neighbours in a circle; even ones share a side with the cell.
    static constexpr std::array<Step, 8> circle = {
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    const Real here = rows.beside(column, 0, 0);
    Real steepest = real(0.0);
    Facet best = {real(0.0), real(0.0), real(0.0), real(0.0)};
    for (std::size_t n = 0; n < circle.size(); ++n) {
        // Facet n lies between neighbours n and n + 1 of the circle.
        const Step by_side = circle[(n + 1) % circle.size() & ~std::size_t{1}];
        const Step by_corner = circle[n | 1U];
        const Real beside = rows.beside(column, by_side.dx, by_side.dy);
        const Real corner = rows.beside(column, by_corner.dx, by_corner.dy);
        const auto step = [&](const Step& to) HWY_ATTR { return real(to.dy * side + to.dx); };
        const Facet facet = {hn::Sub(here, beside), hn::Sub(beside, corner), step(by_side), step(by_corner)};
        const Real slope = facet.slope();
        const auto is_steeper = hn::Gt(slope, steepest);
        best.take_where(is_steeper, facet);
        steepest = hn::IfThenElse(is_steeper, slope, steepest);
    }
    return best;
}

/// Uniform in [0, 1), from integer arithmetic alone.
HWY_INLINE Real chance_of(std::uint64_t seed, Word column, Word row) {
    const Word bits = hn::ShiftRight<11>(hashed(seed, column_part(column), row_part(row)));
    const Real high = hn::Mul(real_of_word(hn::ShiftRight<32>(bits)), real(0x1p32));
    const Real low = real_of_word(hn::And(bits, word(0xffffffffU)));
    return hn::Mul(hn::Add(high, low), real(1.0 / 9007199254740992.0));
}

void ChooseReceivers(const TerrainGrid& ground, int row, std::uint64_t seed, const RowReceivers& to) {
    const ThreeRows rows(ground, row);
    const auto side = static_cast<std::size_t>(ground.side);
    const hn::Rebind<std::int32_t, Reals> whole;
    for (std::size_t column = 0; column < side; column += lane_count) {
        const Facet facet = steepest_facet(rows, column, ground.side);
        const Word columns = hn::Iota(Words(), column);
        const Real chance = chance_of(seed, columns, word(static_cast<std::uint64_t>(row)));
        const auto by_corner = hn::Lt(chance, facet.corner_chance());
        const Real step = hn::IfThenElse(by_corner, facet.corner_step, facet.side_step);
        const Real here = hn::Add(real(static_cast<double>(ground.index(0, row))), real_of_word(columns));
        const auto receivers = hn::DemoteTo(whole, hn::Add(here, step));
        const Real lengths = hn::IfThenElse(by_corner, real(diagonal * ground.cell_m), real(ground.cell_m));
        alignas(64) std::array<std::int32_t, lane_count> some_receivers;
        alignas(64) std::array<double, lane_count> some_lengths;
        hn::Store(receivers, whole, some_receivers.data());
        hn::Store(lengths, Reals(), some_lengths.data());
        const std::size_t count = std::min(side - column, lane_count);
        std::copy_n(some_receivers.begin(), count, &to.receiver[column]);
        std::copy_n(some_lengths.begin(), count, &to.length_m[column]);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::models::procedural

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::models::procedural {

HWY_EXPORT(ChooseReceivers);

void choose_receivers(const TerrainGrid& ground, int row, std::uint64_t seed, const RowReceivers& to) {
    HWY_DYNAMIC_DISPATCH(ChooseReceivers)(ground, row, seed, to);
}

} // namespace octant::models::procedural
#endif
