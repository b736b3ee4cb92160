#include "models/polygons/projected_outline.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::polygons {

namespace {

/// Twice an area over the product of two lengths below which three points are on one line.
constexpr double on_line = 1e-12;

/// -1, 0 or 1: on which side of the line a -> b a point lies.
int side_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
    const double turn = turn_of(a, b, point);
    const double limit = on_line * glm::distance(a, b) * std::max(glm::distance(a, point), glm::distance(b, point));
    return std::abs(turn) <= limit ? 0 : (turn > 0.0 ? 1 : -1);
}

/// Whether a point on the line through a and b lies between them.
bool within(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
    return glm::dot(point - a, point - b) <= 0.0;
}

bool meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const int c_side = side_of(a, b, c);
    const int d_side = side_of(a, b, d);
    const int a_side = side_of(c, d, a);
    const int b_side = side_of(c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) { return true; }
    return (c_side == 0 && within(a, b, c)) || (d_side == 0 && within(a, b, d)) || (a_side == 0 && within(c, d, a)) ||
           (b_side == 0 && within(c, d, b));
}

} // namespace

std::vector<glm::dvec2> projected_outline(std::span<const glm::dvec3> corners_m) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners_m.size(); ++i) {
        sum += glm::cross(corners_m[i] - corners_m[0], corners_m[i + 1] - corners_m[0]);
    }
    const glm::dvec3 normal = glm::normalize(sum);
    const glm::dvec3 aside = std::abs(normal.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, normal));
    const glm::dvec3 up = glm::cross(normal, right);
    std::vector<glm::dvec2> outline;
    for (const glm::dvec3& corner_m : corners_m) {
        const glm::dvec3 from_first_m = corner_m - corners_m[0];
        outline.emplace_back(glm::dot(from_first_m, right), glm::dot(from_first_m, up));
    }
    return outline;
}

double turn_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 first = b - a;
    const glm::dvec2 second = c - a;
    return first.x * second.y - first.y * second.x;
}

std::optional<std::pair<std::size_t, std::size_t>> intersecting_sides(std::span<const glm::dvec2> outline) {
    const std::size_t count = outline.size();
    const auto corner = [&](std::size_t place) { return outline[place % count]; };
    for (std::size_t i = 0; i < count; ++i) {
        const bool folds = side_of(corner(i), corner(i + 1), corner(i + 2)) == 0 &&
                           glm::dot(corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1)) < 0.0;
        if (folds) { return std::pair(i, (i + 1) % count); }
        for (std::size_t j = i + 2; j < count; ++j) {
            const bool neighbours = (j + 1) % count == i;
            if (!neighbours && meet(corner(i), corner(i + 1), corner(j), corner(j + 1))) { return std::pair(i, j); }
        }
    }
    return std::nullopt;
}

} // namespace octant::models::polygons
