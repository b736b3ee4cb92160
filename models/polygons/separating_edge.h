#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <ranges>

namespace octant::models::polygons {

/// Whether a line along an edge of a convex outline has another outline of the same plane on its outer side, or
/// reaching in by at most `reach`. Where neither of two convex outlines has such an edge, they overlap by more than
/// that. Outlines are ranges of corners, counter-clockwise about the normal; `place` gives a corner's glm::dvec3.
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

} // namespace octant::models::polygons
