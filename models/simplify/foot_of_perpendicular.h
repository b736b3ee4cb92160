#pragma once

#include "models/simplify/point6.h"

#include <array>

namespace octant::models::simplify {

using Corners = std::array<Point6, 3>;

/// Where the perpendicular from a point meets a triangle's plane, and the distance to the triangle.
struct Foot {
    /// The foot a P1 + b P2 + c P3 has 0 < a, b, c < 1. A foot on the border counts as outside.
    bool inside = false;
    /// The squared distance to the triangle: to the foot where that is inside, else to the border.
    double distance2 = 0.0;
};

/// Drops the perpendicular from `x`. A triangle without area has no inside.
Foot foot_on(const Corners& triangle, const Point6& x);

} // namespace octant::models::simplify
