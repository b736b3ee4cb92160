#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <iterator>
#include <ranges>

namespace octant::models::polygons {

/// Whether a line along an edge of a convex outline has another outline of the same plane on its
/// outer side, or reaching in by at most `reach`. Where neither of two convex outlines has such an
/// edge, they overlap by more than that. Outlines are ranges of corners (glm::dvec3),
/// counter-clockwise about the normal.
template <class Outline, class Other>
bool edge_parts(
    const Outline& outline, const glm::dvec3& normal, const Other& other, double reach) {
    const auto first = std::ranges::begin(outline);
    const auto last = std::ranges::end(outline);
    for (auto at = first; at != last; ++at) {
        const auto after = std::next(at) == last ? first : std::next(at);
        const glm::dvec3& from = *at;
        const glm::dvec3& to = *after;
        const glm::dvec3 inward = glm::cross(normal, to - from);
        const double limit = reach * glm::length(inward);
        const bool outside = std::ranges::all_of(other, [&](const glm::dvec3& corner) {
            return glm::dot(inward, corner - from) <= limit;
        });
        if (outside) {
            return true;
        }
    }
    return false;
}

} // namespace octant::models::polygons
