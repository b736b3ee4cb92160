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
    if (at.y % 2 != 0) {
        return;
    }
    const hn::Repartition<std::uint32_t, Tag> bits;
    const hn::RebindToFloat<decltype(bits)> real;
    const int odd = at.x & 1;
    const glm::ivec2 first = job.first_px + at + glm::ivec2(odd, 0);
    const NearnessPlane& plane = triangle.nearness;
    const float in_row =
        plane.first + plane.per_y * static_cast<float>(first.y - triangle.first_row);
    const auto two_each = hn::Add(counting_from(real, 0), counting_from(real, 0));
    const auto columns =
        hn::Add(hn::Set(real, static_cast<float>(first.x - triangle.left)), two_each);
    const auto raw = hn::Add(hn::Set(real, in_row), hn::Mul(columns, hn::Set(real, plane.per_x)));
    const auto value = hn::Min(hn::Max(raw, hn::Set(real, plane.least)), hn::Set(real, plane.most));
    const auto in_even = hn::And(hn::BitCast(bits, fresh), hn::Set(bits, 0xffffU << (16 * odd)));
    const auto is_fresh = hn::RebindMask(real, hn::Ne(in_even, hn::Zero(bits)));
    float* const to = buffer.nearness_of_row(at.y) + (at.x + 1) / 2;
    hn::StoreU(hn::IfThenElse(is_fresh, value, hn::LoadU(real, to)), real, to);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
