// Numbers that count up, from a table: Highway's Iota is a loop in the middle of the painting where compilers may not
// vectorize. Included once for each instruction set.
#if defined(OCTANT_RASTER_COUNTING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_COUNTING_INL
#undef OCTANT_RASTER_COUNTING_INL
#else
#define OCTANT_RASTER_COUNTING_INL
#endif

#include "visuals/raster/tile.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// From `first` on, which lies within a tile.
template <class Tag>
HWY_INLINE hn::Vec<Tag> lane_indices_from(Tag tag, std::size_t first) {
    using Number = hn::TFromD<Tag>;
    alignas(64) static constexpr auto numbers = [] {
        std::array<Number, 2 * tile_width> values{};
        for (std::size_t i = 0; i < values.size(); ++i) { values[i] = static_cast<Number>(i); }
        return values;
    }();
    assert(first <= tile_width);
    return hn::LoadU(tag, numbers.data() + first);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
