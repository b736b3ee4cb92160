// Many pieces against a plane, as many at once as the processor can. Compiled once for each instruction set; all give
// the same bits.
#include "visuals/bsp/piece_batch.h"

// SVE's vectors have no size that the compiler knows.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visuals/bsp/piece_batch.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

#include <array>
#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::bsp {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Reals = hn::CappedTag<double, PieceBatch::pieces>;
using Real = hn::Vec<Reals>;

HWY_INLINE Real real(double value) { return hn::Set(Reals(), value); }

HWY_INLINE std::uint64_t bits_of(hn::Mask<Reals> mask) {
    std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(Reals(), mask, bytes.data());
    return bytes[0];
}

/// The heights of some points over a plane, added up in the sequence of distance_m().
struct Heights {
    Real x;
    Real y;
    Real z;
    Real offset;

    HWY_INLINE explicit Heights(const Plane& plane)
        : x(real(plane.normal.x)), y(real(plane.normal.y)), z(real(plane.normal.z)), offset(real(plane.offset_m)) {}

    HWY_INLINE Real of(const PieceBatch::Points& points, std::size_t first) const {
        const auto part = [first](Real normal, const PieceBatch::Lane& places)
                              HWY_ATTR { return hn::Mul(normal, hn::LoadU(Reals(), places.data() + first)); };
        const Real level = hn::Add(part(x, points.x), part(y, points.y));
        return hn::Add(hn::Add(level, part(z, points.z)), offset);
    }
};

/// Adds the sides of as many pieces as a vector holds, from the one of bit `at` on.
HWY_INLINE void add_sides(
    const PieceBatch& lanes, std::size_t at, const Heights& heights, Real tolerance, PieceSideBits& to) {
    const std::size_t first = at % PieceBatch::pieces;
    const Real height = heights.of(lanes.centres, first);
    const Real radius = hn::LoadU(Reals(), lanes.radii.data() + first);
    to.sphere_in_front |= bits_of(hn::Gt(height, radius)) << at;
    to.sphere_behind |= bits_of(hn::Lt(height, hn::Neg(radius))) << at;
    Real highest = heights.of(lanes.first_corners[0], first);
    Real lowest = highest;
    for (std::size_t i = 1; i < PieceBatch::corners; ++i) {
        const Real corner = heights.of(lanes.first_corners[i], first);
        highest = hn::Max(highest, corner);
        lowest = hn::Min(lowest, corner);
    }
    to.corner_in_front |= bits_of(hn::Gt(highest, tolerance)) << at;
    to.corner_behind_plane |= bits_of(hn::Lt(lowest, hn::Neg(tolerance))) << at;
}

PieceSideBits SidesOf(std::span<const PieceBatch> lanes, const Plane& plane, double tolerance) {
    PieceSideBits sides;
    const Heights heights(plane);
    const Real limit = real(tolerance);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        for (std::size_t k = 0; k < PieceBatch::pieces; k += hn::Lanes(Reals())) {
            add_sides(lanes[i], i * PieceBatch::pieces + k, heights, limit, sides);
        }
    }
    return sides;
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::bsp

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::visuals::bsp {

HWY_EXPORT(SidesOf);

PieceSideBits sides_of(std::span<const PieceBatch> lanes, const Plane& plane, double tolerance) {
    return HWY_DYNAMIC_DISPATCH(SidesOf)(lanes, plane, tolerance);
}

} // namespace octant::visuals::bsp
#endif
