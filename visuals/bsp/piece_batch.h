#pragma once

#include "sim/base/plane.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::bsp {

/// Eight pieces side by side in memory: their bounding spheres and first corners, coordinate by coordinate. Where there
/// is no piece numbers are NaN.
struct PieceBatch {
    static constexpr std::size_t pieces = 8;
    static constexpr std::size_t corners = 4; ///< Of a piece with fewer the last one stands again.
    using Lane = std::array<double, pieces>;

    struct Points {
        Lane x{};
        Lane y{};
        Lane z{};
    };

    Points centres;
    Lane radii{};
    std::array<Points, corners> first_corners;
};

/// Of up to 64 pieces a bit each.
struct PieceSideBits {
    std::uint64_t sphere_in_front = 0;     ///< Its sphere lies before a plane,
    std::uint64_t sphere_behind = 0;       ///< or behind it.
    std::uint64_t corner_in_front = 0;     ///< One of its first corners lies before the plane,
    std::uint64_t corner_behind_plane = 0; ///< or behind it.
};

/// On which sides of a plane up to eight lanes lie. Corners within `tolerance` lie on the plane.
PieceSideBits sides_of(std::span<const PieceBatch> lanes, const Plane& plane, double tolerance);

} // namespace octant::visuals::bsp
