#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>

namespace octant::models::measure {

/// The point of a triangle nearest to a given one.
struct NearestOnTriangle {
    glm::dvec3 point{0.0};
    glm::dvec3 weights{0.0}; ///< of the corners: none negative, 1 together
    double distance2 = 0.0;  ///< square of the distance
};

namespace detail {

/// Takes the point of the segment from corner i to corner j that is nearest to the origin, where
/// it is nearer than what was found before. A segment of no length is its first point.
inline void
take_from_edge(const std::array<glm::dvec3, 3>& corners, int i, int j, NearestOnTriangle& found) {
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

/// Whether a corner is nearest to the origin: both edges lead away from there.
inline bool
is_at_corner(const glm::dvec3& corner, const glm::dvec3& to_one, const glm::dvec3& to_other) {
    return glm::dot(corner, to_one) >= 0.0 && glm::dot(corner, to_other) >= 0.0;
}

/// The point of a triangle's plane nearest to the origin, as weights of the corners.
struct NearestInPlane {
    glm::dvec3 weights{-1.0};
    bool uncertain = true; ///< the triangle is nearly a line: weights may be wrong
};

/// Along the longest edge and the height over it, which keeps its accuracy for thin triangles.
inline NearestInPlane nearest_in_plane(
    const std::array<glm::dvec3, 3>& corners,
    const glm::dvec3& ab,
    const glm::dvec3& bc,
    const glm::dvec3& ca) {
    const std::array<const glm::dvec3*, 3> edges = {&ab, &bc, &ca};
    const std::array<double, 3> lengths2 = {glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)};
    int start = lengths2[1] > lengths2[0] ? 1 : 0;
    start = lengths2[2] > lengths2[static_cast<std::size_t>(start)] ? 2 : start;
    const int end = start == 2 ? 0 : start + 1;
    const int apex = end == 2 ? 0 : end + 1;
    const glm::dvec3& base = *edges[static_cast<std::size_t>(start)];
    const glm::dvec3 side = -*edges[static_cast<std::size_t>(apex)];
    const double base2 = lengths2[static_cast<std::size_t>(start)];
    if (!(base2 > 0.0)) {
        return {};
    }
    const double foot = glm::dot(side, base) / base2;
    const glm::dvec3 height = side - foot * base;
    const double height2 = glm::dot(height, height);
    if (!(height2 > 0.0)) {
        return {};
    }
    const glm::dvec3& from = corners[static_cast<std::size_t>(start)];
    const double along = -glm::dot(from, base) / base2;
    const double up = -glm::dot(from + along * base, height) / height2;
    NearestInPlane found;
    found.weights[apex] = up;
    found.weights[end] = along - up * foot;
    found.weights[start] = 1.0 - up - found.weights[end];
    found.uncertain = height2 < 1e-12 * base2;
    return found;
}

/// nearest_on_triangle for the origin.
inline NearestOnTriangle nearest_to_origin(const std::array<glm::dvec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = b - a;
    const glm::dvec3 bc = c - b;
    const glm::dvec3 ca = a - c;
    NearestOnTriangle found{a, {1.0, 0.0, 0.0}, glm::dot(a, a)};
    if (is_at_corner(a, ab, -ca)) {
        return found;
    }
    if (is_at_corner(b, bc, -ab)) {
        return {b, {0.0, 1.0, 0.0}, glm::dot(b, b)};
    }
    if (is_at_corner(c, ca, -bc)) {
        return {c, {0.0, 0.0, 1.0}, glm::dot(c, c)};
    }
    const NearestInPlane plane = nearest_in_plane(corners, ab, bc, ca);
    const glm::dvec3& weights = plane.weights;
    if (weights.x > 0.0 && weights.y > 0.0 && weights.z > 0.0) {
        const glm::dvec3 point = weights.x * a + weights.y * b + weights.z * c;
        const NearestOnTriangle inside{point, weights, glm::dot(point, point)};
        if (!plane.uncertain) {
            return inside;
        }
        found = inside.distance2 < found.distance2 ? inside : found;
    }
    if (plane.uncertain || !(weights.z > 0.0)) {
        take_from_edge(corners, 0, 1, found);
    }
    if (plane.uncertain || !(weights.x > 0.0)) {
        take_from_edge(corners, 1, 2, found);
    }
    if (plane.uncertain || !(weights.y > 0.0)) {
        take_from_edge(corners, 2, 0, found);
    }
    return found;
}

} // namespace detail

/// The point of the triangle a, b, c (its inside, edges and corners) nearest to `point`. By edge
/// vectors from `point`, so that neither the place of the origin nor triangles without area or
/// length matter. The distance is never below the true one by more than rounding: what is found
/// lies on the triangle.
inline NearestOnTriangle nearest_on_triangle(
    const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    NearestOnTriangle found = detail::nearest_to_origin({a - point, b - point, c - point});
    found.point += point;
    return found;
}

} // namespace octant::models::measure
