#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>

namespace octant::models::measure {

/// The point of a triangle that is nearest to a given one.
struct NearestOnTriangle {
    glm::dvec3 point{0.0};
    glm::dvec3 weights{0.0}; ///< Barycentric: those of the corners, none negative, with the sum 1.
    double distance2 = 0.0;  ///< The square of the distance.
};

namespace detail {

/// Replaces `found` by the nearest point of the segment from corner i to corner j if that is nearer
/// to the origin. The nearest point of a segment without length is its first end.
inline void
update_from_edge(const std::array<glm::dvec3, 3>& corners, int i, int j, NearestOnTriangle& found) {
    const glm::dvec3& start = corners[static_cast<std::size_t>(i)];
    const glm::dvec3& end = corners[static_cast<std::size_t>(j)];
    const glm::dvec3 edge = end - start;
    const double length2 = glm::dot(edge, edge);
    const double along =
        length2 > 0.0 ? std::clamp(-glm::dot(start, edge) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 point = along < 1.0 ? start + along * edge : end;
    const double distance2 = glm::dot(point, point);
    if (distance2 < found.distance2) {
        found = {point, glm::dvec3(0.0), distance2};
        found.weights[i] = 1.0 - along;
        found.weights[j] = along;
    }
}

/// Whether a corner is the point of its triangle nearest to the origin: both edges at it lead away
/// from the origin.
inline bool
is_at_corner(const glm::dvec3& corner, const glm::dvec3& to_one, const glm::dvec3& to_other) {
    return glm::dot(corner, to_one) >= 0.0 && glm::dot(corner, to_other) >= 0.0;
}

/// The point of a triangle's plane that is nearest to the origin, as barycentric weights.
struct NearestInPlane {
    glm::dvec3 weights{-1.0};
    bool uncertain = true; ///< The triangle is nearly a line, and the weights may be wrong.
};

/// The nearest point in the plane of a triangle whose longest edge `base` runs from corner 0 to
/// corner 1. It is found along that edge and along the height over it, which keeps its accuracy for
/// thin triangles. The weights are in the order of the corners.
inline NearestInPlane nearest_over_base(
    const glm::dvec3& from, const glm::dvec3& base, const glm::dvec3& side, double base2) {
    const double foot = glm::dot(side, base) / base2;
    const glm::dvec3 height = side - foot * base;
    const double height2 = glm::dot(height, height);
    if (!(height2 > 0.0)) {
        return {};
    }
    const double along = -glm::dot(from, base) / base2;
    const double up = -glm::dot(from + along * base, height) / height2;
    const double end = along - up * foot;
    return {{1.0 - up - end, end, up}, height2 < 1e-12 * base2};
}

/// The nearest point in a triangle's plane: calls nearest_over_base with the longest edge as the
/// base.
inline NearestInPlane nearest_in_plane(
    const std::array<glm::dvec3, 3>& corners,
    const glm::dvec3& ab,
    const glm::dvec3& bc,
    const glm::dvec3& ca) {
    const double ab2 = glm::dot(ab, ab);
    const double bc2 = glm::dot(bc, bc);
    const double ca2 = glm::dot(ca, ca);
    if (ca2 > std::max(ab2, bc2)) {
        const NearestInPlane found = nearest_over_base(corners[2], ca, -bc, ca2);
        return {{found.weights.y, found.weights.z, found.weights.x}, found.uncertain};
    }
    if (bc2 > ab2) {
        const NearestInPlane found = nearest_over_base(corners[1], bc, -ab, bc2);
        return {{found.weights.z, found.weights.x, found.weights.y}, found.uncertain};
    }
    return ab2 > 0.0 ? nearest_over_base(corners[0], ab, -ca, ab2) : NearestInPlane{};
}

/// nearest_on_triangle for the origin.
inline NearestOnTriangle nearest_to_origin(const std::array<glm::dvec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = b - a;
    const glm::dvec3 bc = c - b;
    const glm::dvec3 ca = a - c;
    const NearestInPlane plane = nearest_in_plane(corners, ab, bc, ca);
    const glm::dvec3& weights = plane.weights;
    NearestOnTriangle found{a, {1.0, 0.0, 0.0}, glm::dot(a, a)};
    if (weights.x > 0.0 && weights.y > 0.0 && weights.z > 0.0) {
        const glm::dvec3 point = weights.x * a + weights.y * b + weights.z * c;
        const NearestOnTriangle inside{point, weights, glm::dot(point, point)};
        if (!plane.uncertain) {
            return inside;
        }
        found = inside.distance2 < found.distance2 ? inside : found;
    }
    if (is_at_corner(a, ab, -ca)) {
        return {a, {1.0, 0.0, 0.0}, glm::dot(a, a)};
    }
    if (is_at_corner(b, bc, -ab)) {
        return {b, {0.0, 1.0, 0.0}, glm::dot(b, b)};
    }
    if (is_at_corner(c, ca, -bc)) {
        return {c, {0.0, 0.0, 1.0}, glm::dot(c, c)};
    }
    if (plane.uncertain || !(weights.z > 0.0)) {
        update_from_edge(corners, 0, 1, found);
    }
    if (plane.uncertain || !(weights.x > 0.0)) {
        update_from_edge(corners, 1, 2, found);
    }
    if (plane.uncertain || !(weights.y > 0.0)) {
        update_from_edge(corners, 2, 0, found);
    }
    return found;
}

} // namespace detail

/// The point of the triangle a, b, c, which includes its edges and corners, that is nearest to
/// `point`. Computed with edge vectors and relative to `point`, so that neither a far origin nor
/// triangles without area or length spoil it. The found point lies on the triangle, so that the
/// distance is never below the true one by more than rounding.
inline NearestOnTriangle nearest_on_triangle(
    const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    NearestOnTriangle found = detail::nearest_to_origin({a - point, b - point, c - point});
    found.point += point;
    return found;
}

} // namespace octant::models::measure
