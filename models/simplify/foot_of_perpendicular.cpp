// The distance from a point to a triangle by the foot of the perpendicular: Y. Kim, B. U. Lee,
// "Error measure for vertex simplification", 2005, section II.2, equations (3) to (6) and cases 1
// to 3. Case 1: the foot is inside, and the distance is that to the plane. Case 2: the point lies
// between the two planes through an edge's ends perpendicular to it, and the distance is that to
// the edge. Case 3: the distance is that to the nearest corner.
//
// Deviations:
// - The matrix of (6) is singular for every triangle whose plane contains the origin. The same
//   minimum is found here from the two edge vectors at P1.
// - "a, b, c = 1" is read as a + b + c = 1.
// - In case 2 the nearest of the edges counts. A corner nearer than all of them counts too, for
//   beyond a corner the opposite edge may lie between its planes and yet be far.
// - Everything works in six dimensions, so that colour can count.
#include "models/simplify/foot_of_perpendicular.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace octant::models::simplify {

namespace {

/// Cases 2 and 3: the squared distance to the border of the triangle.
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
    // The squared sine of the angle between the edges, below which the triangle has no area.
    constexpr double collapsed = 1e-14;
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
