#include "models/aircraft/convex_outline.h"

#include <glm/geometric.hpp>

#include <cstddef>

namespace octant::models::aircraft {

namespace {

constexpr double min_area_m2 = 1e-7;

} // namespace

glm::dvec3 area_vector(const Outline& corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return 0.5 * sum;
}

Outline without_duplicates(const Outline& corners) {
    Outline out;
    for (const glm::dvec3& corner : corners) {
        if (out.empty() || glm::distance(out.back(), corner) > coincident_distance_m) { out.push_back(corner); }
    }
    while (out.size() > 1 && glm::distance(out.front(), out.back()) <= coincident_distance_m) { out.pop_back(); }
    return out;
}

bool has_area(const Outline& corners) { return corners.size() >= 3 && glm::length(area_vector(corners)) > min_area_m2; }

Outline in_front(const Outline& corners, const Plane& plane) {
    Outline out;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& from = corners[i];
        const glm::dvec3& to = corners[(i + 1) % corners.size()];
        const double at_from = distance_m(plane, from);
        const double at_to = distance_m(plane, to);
        if (at_from >= -coincident_distance_m) { out.push_back(from); }
        if ((at_from > coincident_distance_m && at_to < -coincident_distance_m) ||
            (at_from < -coincident_distance_m && at_to > coincident_distance_m)) {
            out.push_back(from + (to - from) * (at_from / (at_from - at_to)));
        }
    }
    return without_duplicates(out);
}

} // namespace octant::models::aircraft
