// How near the ground of a tile is where its fine pattern is looked up: at every second pixel of every second row,
// those of a row in two phases, so that places in the pattern can be found for one pair of pixels in two first and for
// those between only where they must. Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_NEARNESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_NEARNESS_INL
#undef OCTANT_RASTER_GRAIN_NEARNESS_INL
#else
#define OCTANT_RASTER_GRAIN_NEARNESS_INL
#endif

#include "visuals/raster/lane_indices-inl.h"
#include "visuals/raster/triangle.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// A lane for two neighbouring pixels.
using PixelPairs = hn::CappedTag<float, 16>;
using PixelPairInts = hn::RebindToSigned<PixelPairs>;
using PixelPairBits = hn::RebindToUnsigned<PixelPairs>;
using PixelPairHalves = hn::Repartition<std::int16_t, PixelPairBits>;
constexpr std::size_t pairs_at_once = hn::MaxLanes(PixelPairs());
constexpr std::size_t pairs_per_row = tile_width / 2;
constexpr std::size_t phases = 2; ///< pairs 0, 2, 4 ..., then 1, 3, 5 ...
constexpr std::size_t pairs_per_phase = pairs_per_row / phases;

HWY_INLINE hn::Vec<PixelPairs> pair_floats(float value) { return hn::Set(PixelPairs(), value); }

HWY_INLINE hn::Vec<PixelPairBits> pair_bits(unsigned value) { return hn::Set(PixelPairBits(), value); }

/// Of two changes the smaller one: at a rim the larger one leads to other ground.
HWY_INLINE hn::Vec<PixelPairs> smaller_change(hn::Vec<PixelPairs> one, hn::Vec<PixelPairs> other) {
    return hn::IfThenElse(hn::Lt(hn::Abs(one), hn::Abs(other)), one, other);
}

/// How near the ground is at the first pixels of pairs, and how that changes to the pixels beside and below.
struct InverseDepthQuad {
    hn::Vec<PixelPairs> here; ///< 1/m; 0: no ground
    hn::Vec<PixelPairs> across;
    hn::Vec<PixelPairs> down;
};

/// Pairs of pixels amid four others.
struct InterpolatedPairs {
    hn::Mask<PixelPairs> is_ground;
    hn::Mask<PixelPairs> is_linear; ///< as near as the mean of these
};

/// The nearness of a tile's pairs by phases, in rows that stand for two of the tile's each. Right of the tile and below
/// it the ground goes on as within it.
class TileInverseDepths {
public:
    HWY_INLINE TileInverseDepths(const TileJob& job, const TileBuffer& buffer) : rows_((job.size_px.y + 1) / 2) {
        for (int row = 0; row < rows_; ++row) { put_row(buffer.ground_of_row(2 * row), row); }
        if (any_ != 0) {
            extend(1, 0, -1, true);
            extend(rows_ - 2, rows_ - 1, rows_, false);
            std::fill_n(of_row(rows_ + 1), row_size, 0.0F);
        }
    }

    int rows() const { return rows_; }

    bool has_ground() const { return any_ != 0; }

    /// Whether a pair of a row sees ground; beyond the last row as in it.
    bool has_ground(int row) const { return (any_ >> std::min(row, rows_ - 1) & 1U) != 0; }

    /// Of pairs of a row and phase, from one of them on. None below what is no ground: a pixel at the horizon may be
    /// half sky.
    HWY_INLINE InverseDepthQuad at(int row, std::size_t phase, std::size_t first) const {
        const float* const own = of_row(row) + first + (phase == 0 ? 0 : odd_pairs);
        const float* const before = phase == 0 ? own + odd_pairs - 1 : own - odd_pairs;
        const PixelPairs real;
        return between(hn::LoadU(real, own), {hn::LoadU(real, before), hn::LoadU(real, before + 1)},
            {hn::LoadU(real, own - row_size), hn::LoadU(real, own + row_size)});
    }

    /// Those of a phase amid the nearest ones of the first phase in rows of even number.
    HWY_INLINE InterpolatedPairs interpolated_at(int row, std::size_t phase, std::size_t first) const {
        const PixelPairs real;
        const float* const own = of_row(row) + first + (phase == 0 ? 0 : odd_pairs);
        const float* const before = phase == 0 ? own + odd_pairs - 1 : own - odd_pairs;
        const auto both = [&](const float* corner)
                              HWY_ATTR { return hn::Add(hn::LoadU(real, corner), hn::LoadU(real, corner + phase)); };
        const int away = row & 1;
        const auto around = hn::Add(both(of_row(row - away) + first), both(of_row(row + away) + first));
        const auto here = hn::LoadU(real, own);
        constexpr float max_off = 1.0F / 64.0F; // of four times itself: a pixel's height
        const auto off = hn::Sub(hn::Mul(here, pair_floats(4.0F)), around);
        const auto above = hn::LoadU(real, own - row_size);
        return {is_seen(here, above, hn::LoadU(real, before), hn::LoadU(real, before + 1)),
            hn::Le(hn::Abs(off), hn::Mul(here, pair_floats(max_off)))};
    }

    /// Of what lies right of the tile, in rows from one on.
    HWY_INLINE InverseDepthQuad right_of_tile(int first_row) const {
        std::array<std::array<float, pairs_at_once>, 4> columns{};
        for (std::size_t i = 0; i < pairs_at_once; ++i) {
            const int row = first_row + static_cast<int>(i);
            if (row < rows_) {
                const float* const right = of_row(row) + pairs_per_phase;
                columns[0][i] = right[0];
                columns[1][i] = right[odd_pairs - 1];
                columns[2][i] = right[-static_cast<std::ptrdiff_t>(row_size)];
                columns[3][i] = right[row_size];
            }
        }
        const auto column = [&](std::size_t which) HWY_ATTR { return hn::LoadU(PixelPairs(), columns[which].data()); };
        return between(column(0), {column(1), hn::Zero(PixelPairs())}, {column(2), column(3)});
    }

private:
    static constexpr std::size_t odd_pairs = 32; ///< from those of the first phase to the others
    static constexpr std::size_t row_size = 2 * odd_pairs;
    static constexpr std::size_t max_rows = tile_height / 2;
    static_assert(pairs_per_phase + 1 < odd_pairs);

    static HWY_INLINE hn::Mask<PixelPairs> is_seen(
        hn::Vec<PixelPairs> own, hn::Vec<PixelPairs> above, hn::Vec<PixelPairs> before, hn::Vec<PixelPairs> next) {
        const auto least = hn::Min(hn::Min(own, above), hn::Max(before, next));
        return hn::Gt(least, hn::Zero(PixelPairs()));
    }

    static HWY_INLINE InverseDepthQuad between(hn::Vec<PixelPairs> own,
        const std::array<hn::Vec<PixelPairs>, 2>& right_of_tile,
        const std::array<hn::Vec<PixelPairs>, 2>& above_and_below) {
        const auto& [before, next] = right_of_tile;
        const auto& [above, below] = above_and_below;
        const auto half = pair_floats(0.5F);
        return {hn::IfThenElseZero(is_seen(own, above, before, next), own),
            hn::Mul(smaller_change(hn::Sub(next, own), hn::Sub(own, before)), half),
            hn::Mul(smaller_change(hn::Sub(below, own), hn::Sub(own, above)), half)};
    }

    const float* of_row(int row) const { return near_.data() + static_cast<std::size_t>(row + 1) * row_size; }

    float* of_row(int row) { return const_cast<float*>(std::as_const(*this).of_row(row)); }

    HWY_INLINE void put_row(const std::uint32_t* ground, int row) {
        const PixelPairs real;
        const PixelPairBits bits;
        float* const to = of_row(row);
        const auto near_bits = pair_bits(~PackedGround::cover_bits);
        auto any = hn::Zero(bits);
        for (std::size_t i = 0; i < pairs_per_phase; i += pairs_at_once) {
            hn::Vec<PixelPairBits> even;
            hn::Vec<PixelPairBits> odd;
            hn::LoadInterleaved2(bits, ground + phases * i, even, odd);
            hn::StoreU(hn::BitCast(real, hn::And(even, near_bits)), real, to + i);
            hn::StoreU(hn::BitCast(real, hn::And(odd, near_bits)), real, to + odd_pairs + i);
            any = hn::Or(any, hn::Or(even, odd));
        }
        const float last = to[odd_pairs + pairs_per_phase - 1];
        const float before = to[pairs_per_phase - 1];
        to[pairs_per_phase] = std::min(last, before) > 0.0F ? std::max(2.0F * last - before, 0.0F) : 0;
        to[odd_pairs - 1] = 0.0F;
        const std::uint32_t bit = std::uint32_t{1} << row;
        any_ |= hn::AllTrue(bits, hn::Eq(any, hn::Zero(bits))) ? 0U : bit;
    }

    /// The row beyond one at the tile's border, by the one before it, which need not see ground.
    HWY_INLINE void extend(int from, int last, int beyond, bool alone) {
        const PixelPairs real;
        const bool has_from = from >= 0 && from < rows_;
        for (std::size_t i = 0; i < row_size; i += pairs_at_once) {
            const auto own = hn::LoadU(real, of_row(last) + i);
            const auto before = has_from ? hn::LoadU(real, of_row(from) + i) : own;
            const auto is_ground = hn::Gt(before, hn::Zero(real));
            const auto next = hn::Max(hn::Sub(hn::Add(own, own), before), hn::Mul(own, pair_floats(0.25F)));
            const auto otherwise = alone ? own : hn::Zero(real);
            hn::StoreU(hn::IfThenElse(is_ground, next, otherwise), real, of_row(beyond) + i);
        }
    }

    int rows_;
    std::uint32_t any_ = 0;
    alignas(64) std::array<float, (max_rows + 3) * row_size> near_; ///< set as far as at() reads
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
