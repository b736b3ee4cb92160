#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <vector>

namespace octant::models::polygons {

/// Whether the line of an edge of a convex outline separates it from another outline of the same plane, up to an
/// overlap of `reach`. Two convex outlines overlap by more than that if neither has such an edge. Outlines are ranges
/// of corners, counter-clockwise about the normal; `place` returns the position of a corner (glm::dvec3).
template <class Outline, class Other, class Place = std::identity>
bool has_separating_edge(
    const Outline& outline, const glm::dvec3& normal, const Other& other, double reach, const Place& place = {}) {
    const auto first = std::ranges::begin(outline);
    const auto last = std::ranges::end(outline);
    for (auto at = first; at != last; ++at) {
        const auto after = std::next(at) == last ? first : std::next(at);
        const glm::dvec3& from = place(*at);
        const glm::dvec3& to = place(*after);
        const glm::dvec3 inward = glm::cross(normal, to - from);
        const double limit = reach * glm::length(inward);
        const auto is_outside = [&](const glm::dvec3& corner) { return glm::dot(inward, corner - from) <= limit; };
        const bool outside = std::ranges::all_of(other, is_outside, place);
        if (outside) { return true; }
    }
    return false;
}

/// Whether a point of an outline's plane lies inside it (even-odd rule; points on a side may be either). `normal` of
/// the plane has any length. Does not use the lines of the sides, because the direction of a very short side is
/// arbitrary.
bool is_inside(std::span<const glm::dvec3> corners, const glm::dvec3& normal, const glm::dvec3& point);

/// The distance of a point from the nearest side of an outline, ends included.
double distance_to_sides(std::span<const glm::dvec3> corners, const glm::dvec3& point);

/// Cuts a polygon of at least three corners into triangles, given by indices into `corners_m` in the polygon's
/// orientation. A strictly convex polygon becomes a fan around its first corner. Other polygons are cut by ear clipping
/// in the projection along their mean normal, so that corners on a straight side produce no triangle without an area.
/// Returns two triangles fewer than corners even for self-intersecting polygons and those without an area, whose
/// triangles may overlap. Time grows with the square of the number of corners.
std::vector<std::array<std::size_t, 3>> triangulate_polygon(std::span<const glm::dvec3> corners_m);

/// The convex planar pieces of a polygon.
struct ConvexPieces {
    /// Indices of the polygon's corners, counter-clockwise as in the polygon; empty if there is a fault.
    std::vector<std::vector<std::size_t>> pieces;
    std::string fault; ///< "expected ..., got ..." if the polygon cannot be cut, else empty
};

/// Cuts a planar or bent polygon without holes into pieces in which corners_fault (polygon_model.h) finds no fault at
/// this tolerance. Adds no vertices. A planar polygon gets at most four times the minimum number of pieces, usually the
/// minimum. A bent polygon is cut in the projection along its mean normal; neighbouring pieces in one plane are joined.
///
/// Faults: those of outline_fault, and sides that meet other than at a common corner in the projection. Messages number
/// the corners from 1. Time grows with the square of the number of corners, in the worst case with the cube.
ConvexPieces convex_pieces(std::span<const glm::dvec3> corners_m, double tolerance_m);

} // namespace octant::models::polygons
