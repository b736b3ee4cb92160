#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace octant::models::polygons {

/// A polygon cut into convex planar pieces between its own corners.
struct ConvexPieces {
    /// Places in the polygon's list of corners, counter-clockwise as there; empty where `fault` says why it cannot be
    /// cut.
    std::vector<std::vector<std::size_t>> pieces;
    std::string fault; ///< "expected ..., got ..."; else empty
};

/// Cuts a polygon without holes, planar or bent, into pieces in which corners_fault (polygon_check.h) finds no fault at
/// this tolerance. No vertices are added. A planar polygon has at most four times the fewest possible pieces, mostly
/// the fewest. A bent one is cut as it looks along its mean normal; neighbouring pieces become one where they lie in
/// one plane.
///
/// Refused: what outline_fault finds, sides that meet anywhere but at their common corner (seen along the mean normal).
/// Corners are named by their place in the polygon, from 1. Time grows with the square of the number of corners, at
/// worst with its cube.
ConvexPieces convex_pieces(std::span<const glm::dvec3> corners_m, double tolerance_m);

} // namespace octant::models::polygons
