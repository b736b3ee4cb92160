#pragma once

#include "models/simplify/point6.h"

#include <array>

namespace octant::models::simplify {

using Corners = std::array<Point6, 3>;

/// The perpendicular from a point on a triangle.
struct Foot {
    bool inside = false; ///< 0 < a, b, c < 1 for the foot a P1 + b P2 + c P3; borders are outside
    double distance2 =
        0.0; ///< to the triangle, squared: to the foot where inside, else to the border
};

/// Drops the perpendicular from `x`. A triangle without area has no inside.
Foot foot_on(const Corners& triangle, const Point6& x);

} // namespace octant::models::simplify
