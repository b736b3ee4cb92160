// How near the ground is at every second pixel of every second row that is newly covered: what its
// fine pattern is placed by when the tile's triangles are painted. Included once for each
// instruction set.
#if defined(OCTANT_RASTER_NEARNESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_NEARNESS_INL
#undef OCTANT_RASTER_NEARNESS_INL
#else
#define OCTANT_RASTER_NEARNESS_INL
#endif

#include "visuals/raster/strip_level-inl.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using HalfStrip = hn::Half<Strip>;

/// Of a triangle's pixels from a column of the tile on, as many as a register of `Tag` has.
template <class Tag>
class NearnessOfColumns {
public:
    HWY_INLINE NearnessOfColumns(const Triangle& triangle, const TileJob& job, int column)
        : plane_(triangle.nearness)
        , first_row_(job.first_px.y - triangle.first_row)
        , column_(column)
        , is_even_(hn::Set(Bits(), 0xffffU << (16 * (column & 1)))) {
        const int first = job.first_px.x + column + (column & 1);
        const auto two_each = hn::Add(counting_from(Real(), 0), counting_from(Real(), 0));
        const auto columns =
            hn::Add(hn::Set(Real(), static_cast<float>(first - triangle.left)), two_each);
        steps_ = hn::Mul(columns, hn::Set(Real(), plane_.per_x));
    }

    /// Writes it for those in even columns of an even row of the tile where samples are fresh.
    HWY_INLINE void put(int row, hn::Vec<Tag> fresh, TileBuffer& buffer) const {
        const Real real;
        const float in_row = plane_.first + plane_.per_y * static_cast<float>(first_row_ + row);
        const auto raw = hn::Add(hn::Set(real, in_row), steps_);
        const auto value =
            hn::Min(hn::Max(raw, hn::Set(real, plane_.least)), hn::Set(real, plane_.most));
        const auto in_even = hn::And(hn::BitCast(Bits(), fresh), is_even_);
        const auto is_fresh = hn::RebindMask(real, hn::Ne(in_even, hn::Zero(Bits())));
        float* const to = buffer.nearness_of_row(row) + (column_ + 1) / 2;
        hn::StoreU(hn::IfThenElse(is_fresh, value, hn::LoadU(real, to)), real, to);
    }

private:
    using Bits = hn::Repartition<std::uint32_t, Tag>;
    using Real = hn::RebindToFloat<Bits>;

    const NearnessPlane& plane_;
    int first_row_; ///< of the tile, counted from the triangle's
    int column_;
    hn::Vec<Bits> is_even_; ///< the columns, in pairs of pixels
    hn::Vec<Real> steps_;   ///< from the triangle's first column
};

/// Writes it for those of a row's pixels that lie in even columns and rows of the tile, where
/// samples are fresh. The row begins at a column and row of the tile.
template <class Tag>
HWY_INLINE void put_nearness(
    Tag /*pixels*/,
    const Triangle& triangle,
    const TileJob& job,
    const glm::ivec2& at,
    hn::Vec<Tag> fresh,
    TileBuffer& buffer) {
    if (at.y % 2 == 0) {
        NearnessOfColumns<Tag>(triangle, job, at.x).put(at.y, fresh, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
