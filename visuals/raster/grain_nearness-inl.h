// How near the ground of a tile is, where its fine pattern is looked up: every fourth pair of
// pixels side by side, so that the pattern can be found for one pair of four first and for those
// between only where it must.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_NEARNESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_NEARNESS_INL
#undef OCTANT_RASTER_GRAIN_NEARNESS_INL
#else
#define OCTANT_RASTER_GRAIN_NEARNESS_INL
#endif

#include "visuals/raster/tile_counting-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// A lane for two neighbouring pixels; all sets that hold more than eight take eight, so that the
/// same eighths of a row are looked at together everywhere.
using Twos = hn::CappedTag<float, 8>;
using TwosWhole = hn::RebindToSigned<Twos>;
using TwosBits = hn::RebindToUnsigned<Twos>;
constexpr std::size_t twos_at_once = hn::MaxLanes(Twos());
constexpr std::size_t twos_a_row = tile_width / 2;
constexpr std::size_t phases = 4; ///< pairs 0, 4, 8 ..., then 1, 5, 9 ... and so on
constexpr std::size_t twos_a_phase = twos_a_row / phases;

HWY_INLINE hn::Vec<Twos> twos(float value) {
    return hn::Set(Twos(), value);
}

HWY_INLINE hn::Vec<TwosBits> twos_of(unsigned value) {
    return hn::Set(TwosBits(), value);
}

/// Of two changes the smaller one: at a rim the larger one leads to other ground.
HWY_INLINE hn::Vec<Twos> smaller_change(hn::Vec<Twos> one, hn::Vec<Twos> other) {
    return hn::IfThenElse(hn::Lt(hn::Abs(one), hn::Abs(other)), one, other);
}

/// How near the ground is at the first pixels of pairs, and how that changes to the pixels beside
/// and below.
struct Nearness {
    hn::Vec<Twos> here; ///< 1/m; 0: no ground
    hn::Vec<Twos> across;
    hn::Vec<Twos> down;
};

/// The nearness of a tile's pairs by phases. Beyond the tile the ground goes on as within it.
class TileNearness {
public:
    HWY_INLINE TileNearness(const TileJob& job, const TileBuffer& buffer) {
        for (int row = 0; row < job.size_px.y; ++row) {
            const float* near = buffer.nearness_of_row(row);
            alignas(64) std::array<float, twos_a_row> whole;
            if (job.size_px.x < tile_width) {
                lengthen(near, (job.size_px.x + 1) / 2, whole);
                near = whole.data();
            }
            put_row(near, row);
        }
        const int last = job.size_px.y - 1;
        const std::uint32_t at_ends = std::uint32_t{1} << last;
        inside_ = all_ & (all_ << 1 | 1U) & (all_ >> 1 | at_ends);
        mirror(0, std::min(1, last), -1);
        mirror(last, std::max(last - 1, 0), last + 1);
    }

    bool has_ground() const { return any_ != 0; }

    /// Whether a pair of a row sees ground.
    bool has_ground(int row) const { return (any_ >> row & 1U) != 0; }

    /// Whether all pairs of a row do, and those above and below.
    bool is_inside(int row) const { return (inside_ >> row & 1U) != 0; }

    /// Of pairs of a row and phase, from one of them on. None where what lies beside is no ground:
    /// a pixel at the rim may be half sky.
    HWY_INLINE Nearness at(int row, std::size_t phase, std::size_t first) const {
        const auto load = [&](int of_row, std::ptrdiff_t steps) HWY_ATTR {
            return hn::LoadU(
                Twos(), of_pair(of_row, static_cast<std::ptrdiff_t>(phase) + steps) + first);
        };
        const auto own = load(row, 0);
        const auto before = load(row, -1);
        const auto next = load(row, 1);
        const auto above = load(row - 1, 0);
        const auto below = load(row + 1, 0);
        const auto least = hn::Min(own, hn::Min(hn::Min(above, below), hn::Min(before, next)));
        const auto of_two = smaller_change(hn::Sub(next, own), hn::Sub(own, before));
        return {
            hn::IfThenElseZero(hn::Gt(least, hn::Zero(Twos())), own),
            hn::Mul(of_two, twos(0.5F)),
            smaller_change(hn::Sub(below, own), hn::Sub(own, above))};
    }

private:
    static constexpr std::size_t room = 4; ///< before and behind the pairs of each phase
    static constexpr std::size_t phase_size = twos_a_phase + 2 * room;
    static constexpr std::size_t row_size = phases * phase_size;

    /// Where the pairs of a phase begin: beyond those of a row, the next ones.
    const float* of_pair(int row, std::ptrdiff_t pair) const {
        constexpr auto count = static_cast<std::ptrdiff_t>(phases);
        const std::ptrdiff_t phase = (pair + count) % count;
        const std::ptrdiff_t later = pair < 0 ? -1 : pair / count;
        return of_row(row) + phase * static_cast<std::ptrdiff_t>(phase_size) + later;
    }

    /// The row's first pair.
    const float* of_row(int row) const {
        return near_.data() + static_cast<std::size_t>(row + 1) * row_size + room;
    }

    float* of_row(int row) { return const_cast<float*>(std::as_const(*this).of_row(row)); }

    /// Goes on beyond the last pair of a tile at the picture's right border.
    static void lengthen(const float* near, int pairs, std::array<float, twos_a_row>& whole) {
        const auto count = static_cast<std::size_t>(pairs);
        std::copy_n(near, count, whole.begin());
        const bool goes_on = count > 1 && std::min(near[count - 1], near[count - 2]) > 0.0F;
        const float step = goes_on ? near[count - 1] - near[count - 2] : 0.0F;
        for (std::size_t i = count; i < whole.size(); ++i) {
            whole[i] = whole[i - 1] + step;
        }
    }

    HWY_INLINE void put_row(const float* near, int row) {
        const Twos real;
        float* const to = of_row(row);
        auto least = twos(near[0]);
        auto most = least;
        for (std::size_t i = 0; i < twos_a_phase; i += twos_at_once) {
            hn::Vec<Twos> a;
            hn::Vec<Twos> b;
            hn::Vec<Twos> c;
            hn::Vec<Twos> d;
            hn::LoadInterleaved4(real, near + phases * i, a, b, c, d);
            hn::StoreU(a, real, to + i);
            hn::StoreU(b, real, to + phase_size + i);
            hn::StoreU(c, real, to + 2 * phase_size + i);
            hn::StoreU(d, real, to + 3 * phase_size + i);
            least = hn::Min(least, hn::Min(hn::Min(a, b), hn::Min(c, d)));
            most = hn::Max(most, hn::Max(hn::Max(a, b), hn::Max(c, d)));
        }
        to[3 * phase_size - 1] = near[0] + near[0] - near[1];
        float beyond = near[twos_a_row - 1];
        const float step = beyond - near[twos_a_row - 2];
        for (std::size_t phase = 0; phase < phases; ++phase) {
            beyond += step;
            to[phase * phase_size + twos_a_phase] = beyond;
        }
        const std::uint32_t bit = std::uint32_t{1} << row;
        const auto zero = hn::Zero(real);
        any_ |= hn::AllTrue(real, hn::Eq(most, zero)) ? 0U : bit;
        all_ |= hn::AllTrue(real, hn::Gt(least, zero)) ? bit : 0U;
    }

    /// The row beyond one at the tile's border, by the one before it; without what lies beside.
    HWY_INLINE void mirror(int row, int before, int beyond) {
        const Twos real;
        const float* const own = of_row(row);
        const float* const other = of_row(before);
        float* const to = of_row(beyond);
        for (std::size_t phase = 0; phase < row_size; phase += phase_size) {
            for (std::size_t i = phase; i < phase + twos_a_phase; i += twos_at_once) {
                const auto here = hn::LoadU(real, own + i);
                hn::StoreU(hn::Sub(hn::Add(here, here), hn::LoadU(real, other + i)), real, to + i);
            }
        }
    }

    std::uint32_t any_ = 0;
    std::uint32_t all_ = 0;
    std::uint32_t inside_ = 0;
    alignas(64) std::array<float, (tile_height + 2) * row_size> near_; ///< set as far as at() reads
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
