// What the fine pattern of ground is found by when a tile's triangles are painted: at every second pixel of every
// second row that is newly covered, how near the ground is and what covers it. Included once for each instruction set.
#if defined(OCTANT_RASTER_NEARNESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_NEARNESS_INL
#undef OCTANT_RASTER_NEARNESS_INL
#else
#define OCTANT_RASTER_NEARNESS_INL
#endif

#include "visuals/raster/strip_gradient-inl.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// How a triangle of levels is painted.
enum class PaintAs : std::uint8_t {
    Plain,  ///< in a picture without the fine pattern
    Ground, ///< ground that shows it
    Beside  ///< anything else in a picture with it: its samples are counted
};

/// The ground of a triangle at pixels from a column of the tile on, as many as a register of `Tag` has:
/// TileBuffer::ground.
template <class Tag>
class GroundOfColumns {
public:
    HWY_INLINE GroundOfColumns(const Triangle& triangle, const TileJob& job, int column)
        : plane_(triangle.inverse_depth), first_row_(job.first_px.y - triangle.first_row), column_(column),
          is_even_(hn::Set(Bits(), 0xffffU << (16 * (column & 1)))) {
        const int first = job.first_px.x + column + (column & 1);
        const auto two_each = hn::Add(lane_indices_from(Real(), 0), lane_indices_from(Real(), 0));
        const auto columns = hn::Add(hn::Set(Real(), static_cast<float>(first - triangle.left)), two_each);
        steps_ = hn::Mul(columns, hn::Set(Real(), plane_.per_x));
        const auto twice = hn::Add(lane_indices_from(Whole(), 0), lane_indices_from(Whole(), 0));
        cover_steps_ = hn::Mul(twice, hn::Set(Whole(), triangle.gradients.per_x[3]));
        const glm::ivec2 at(first, job.first_px.y);
        first_cover_ = PackedGround::first_cover(triangle.gradients, at);
        cover_per_row_ = static_cast<std::uint32_t>(triangle.gradients.per_y[3]);
        min_cover_ = hn::Set(Whole(), PackedGround::limit(triangle.gradients.least[3]));
        max_cover_ = hn::Set(Whole(), PackedGround::limit(triangle.gradients.most[3]));
    }

    /// Writes it for those in even columns of an even row of the tile where samples are fresh.
    HWY_INLINE void put(int row, hn::Vec<Tag> fresh, TileBuffer& buffer) const {
        const Real real;
        const Bits bits;
        const float in_row = plane_.first + plane_.per_y * static_cast<float>(first_row_ + row);
        const auto raw = hn::Add(hn::Set(real, in_row), steps_);
        const auto near = hn::Min(hn::Max(raw, hn::Set(real, plane_.least)), hn::Set(real, plane_.most));
        const auto cover_in_row =
            static_cast<std::int32_t>(first_cover_ + cover_per_row_ * static_cast<std::uint32_t>(row));
        const auto raw_cover = hn::Add(hn::Set(Whole(), cover_in_row), cover_steps_);
        const auto cover = hn::BitCast(bits, hn::Min(hn::Max(raw_cover, min_cover_), max_cover_));
        const auto both = hn::Or(hn::AndNot(hn::Set(bits, PackedGround::cover_bits), hn::BitCast(bits, near)),
            hn::ShiftRight<PackedGround::cover_shift>(cover));
        const auto is_fresh = hn::Ne(hn::And(hn::BitCast(bits, fresh), is_even_), hn::Zero(bits));
        std::uint32_t* const to = buffer.ground_of_row(row) + (column_ + 1) / 2;
        hn::BlendedStore(both, is_fresh, bits, to);
    }

private:
    using Bits = hn::Repartition<std::uint32_t, Tag>;
    using Real = hn::RebindToFloat<Bits>;
    using Whole = hn::RebindToSigned<Bits>;

    const InverseDepthPlane& plane_;
    int first_row_; ///< of the tile, counted from the triangle's
    int column_;
    hn::Vec<Bits> is_even_;      ///< the columns, in pairs of pixels
    hn::Vec<Real> steps_;        ///< from the triangle's first column
    hn::Vec<Whole> cover_steps_; ///< from the first even column
    hn::Vec<Whole> min_cover_;
    hn::Vec<Whole> max_cover_;
    std::uint32_t first_cover_; ///< of the first even column, in the tile's first row
    std::uint32_t cover_per_row_;
};

/// Writes it for those of a row's pixels that lie in even columns and rows of the tile, where samples are fresh. The
/// row begins at a column and row of the tile.
template <class Tag>
HWY_INLINE void put_ground(Tag /*pixels*/, const Triangle& triangle, const TileJob& job, const glm::ivec2& at,
    hn::Vec<Tag> fresh, TileBuffer& buffer) {
    if (at.y % 2 == 0) { GroundOfColumns<Tag>(triangle, job, at.x).put(at.y, fresh, buffer); }
}

/// Counts samples that show no ground with the fine pattern.
template <class Tag>
HWY_INLINE void count_other_than_ground(Tag pixels, std::size_t pixel, hn::Vec<Tag> counts, TileBuffer& buffer) {
    std::uint16_t* const other_than_ground = buffer.sums[3].data() + pixel;
    hn::StoreU(hn::Add(hn::LoadU(pixels, other_than_ground), counts), pixels, other_than_ground);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
