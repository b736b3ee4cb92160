// Distance of a point to a triangle by the foot of the perpendicular.
//
// Source: Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, section II.2,
// equations (3) to (6) and cases 1 to 3.
// Deviations: the matrix of (6) is singular for every triangle whose plane holds the origin; the
// same minimum is found from the two edge vectors at P1. "a, b, c = 1" is read as a + b + c = 1. In
// case 2 the nearest of the edges counts; a corner that is nearer than all of them counts too, as
// beyond a corner the opposite edge may lie between its planes and yet be far. Works in any
// dimension, so that colour can count.

#include "models/simplify/foot_of_perpendicular.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace octant::models::simplify {

namespace {

/// Cases 2 and 3.
double border_distance2(const Corners& triangle, const Point6& x) {
    double least = squared_distance(x, triangle[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        const Point6& from = triangle[i];
        const Point6 edge = triangle[(i + 1) % 3] - from;
        const double length2 = dot(edge, edge);
        const double reach = dot(x - from, edge);
        if (reach > 0.0 && reach < length2) {
            least = std::min(least, squared_distance(x, along(from, reach / length2, edge)));
        } else {
            least = std::min(least, squared_distance(x, from));
        }
    }
    return least;
}

bool strictly_between_0_and_1(double part) {
    return part > 0.0 && part < 1.0;
}

} // namespace

Foot foot_on(const Corners& triangle, const Point6& x) {
    const Point6 u = triangle[1] - triangle[0];
    const Point6 v = triangle[2] - triangle[0];
    const Point6 r = x - triangle[0];
    const double uu = dot(u, u);
    const double uv = dot(u, v);
    const double vv = dot(v, v);
    const double area2 = uu * vv - uv * uv;
    constexpr double collapsed = 1e-14; // squared sine between the edges
    if (area2 > collapsed * uu * vv) {
        const double ru = dot(r, u);
        const double rv = dot(r, v);
        const double b = (vv * ru - uv * rv) / area2;
        const double c = (uu * rv - uv * ru) / area2;
        const double a = 1.0 - b - c;
        if (strictly_between_0_and_1(a) && strictly_between_0_and_1(b) &&
            strictly_between_0_and_1(c)) {
            return {true, squared_distance(r, along(along({}, b, u), c, v))};
        }
    }
    return {false, border_distance2(triangle, x)};
}

} // namespace octant::models::simplify
