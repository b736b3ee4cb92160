#pragma once

#include "models/polygons/polygon_model.h"

#include <cstdint>

namespace octant::tests {

/// Small models for tests of draw orders: body axes, metres, near the origin. All polygons are convex and planar;
/// solids are closed and face outward; plates are two opposite faces.

/// A solid U channel, 4 long (x), 3 wide (y), 2 deep (z), open towards -z: 14 polygons.
models::polygons::PolygonModel u_channel();

/// Two boxes with a plate between them that is wider than both: 14 polygons. The first six are the box at -x, then the
/// plate, then the box at +x.
models::polygons::PolygonModel plate_between_boxes();

/// Three plates around the direction (1, 1, 1), each over the next: 6 polygons, fronts first. For an eye in that
/// direction, or opposite to it, no painting order exists unless one of them is cut.
models::polygons::PolygonModel three_bars();

/// Fig. 14 of the 1989 paper: rectangle HIJK (polygon 0) and triangle ABC (1), which pass through one another; D and E,
/// where two sides of the triangle meet the rectangle, lie inside it. Each is seen from one side; with `both_sides`
/// their backs follow as polygons 2 and 3.
models::polygons::PolygonModel fig_14(bool both_sides = false);

/// models::torus with so many quads: 416 = 26 x 16, 1000 = 40 x 25; any other number becomes the two factors whose
/// ratio is nearest 1.6.
models::polygons::PolygonModel torus(int quads);

/// Convex bodies in random attitudes that lie close together and neither touch nor overlap: by turns a box (6
/// polygons), a tetrahedron (4), a prism on a triangle (5) and on a hexagon (8), one part each. The same seed gives the
/// same pile.
models::polygons::PolygonModel pile(std::uint64_t seed, int bodies);

/// About 1,000 polygons, for timings: pile(1989, 174) with 999 of them.
models::polygons::PolygonModel big_pile();

} // namespace octant::tests
