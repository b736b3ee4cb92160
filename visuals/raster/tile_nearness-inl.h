// How near the ground is at each pixel that is newly covered: what its fine pattern is placed by
// when the tile's triangles are painted.
// Included once for each instruction set.
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
constexpr std::size_t half_part_px = part_px / 2;

/// Writes it for half a part of a strip, which begins at a column and row of the picture, where
/// samples are fresh.
HWY_INLINE void
put_nearness(const Triangle& triangle, const glm::ivec2& at, hn::Vec<HalfStrip> fresh, float* to) {
    const hn::Rebind<float, HalfStrip> real;
    const hn::Rebind<std::uint32_t, HalfStrip> bits;
    const NearnessPlane& plane = triangle.nearness;
    const float in_row = plane.first + plane.per_y * static_cast<float>(at.y - triangle.first_row);
    const auto first_column = hn::Set(real, static_cast<float>(at.x - triangle.left));
    const auto columns = hn::Add(first_column, counting_from(real, 0));
    const auto raw = hn::Add(hn::Set(real, in_row), hn::Mul(columns, hn::Set(real, plane.per_x)));
    const auto value = hn::Min(hn::Max(raw, hn::Set(real, plane.least)), hn::Set(real, plane.most));
    const auto is_fresh = hn::RebindMask(real, hn::Ne(hn::PromoteTo(bits, fresh), hn::Zero(bits)));
    hn::StoreU(hn::IfThenElse(is_fresh, value, hn::LoadU(real, to)), real, to);
}

/// The same for a whole part.
HWY_INLINE void put_nearness_of_part(
    const Triangle& triangle, const glm::ivec2& at, hn::Vec<Strip> fresh, float* to) {
    const glm::ivec2 second = at + glm::ivec2(static_cast<int>(half_part_px), 0);
    put_nearness(triangle, at, hn::LowerHalf(HalfStrip(), fresh), to);
    put_nearness(triangle, second, hn::UpperHalf(HalfStrip(), fresh), to + half_part_px);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
