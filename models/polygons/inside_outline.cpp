#include "models/polygons/inside_outline.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace octant::models::polygons {

bool is_inside(std::span<const glm::dvec3> corners, const glm::dvec3& normal, const glm::dvec3& point) {
    const glm::dvec3 steep = glm::abs(normal);
    const int most = steep.y > steep.x ? 1 : 0;
    const int across = steep.z > steep[most] ? 2 : most;
    const int u = (across + 1) % 3;
    const int v = (across + 2) % 3;
    bool inside = false;
    const glm::dvec3* from = &corners.back();
    for (const glm::dvec3& to : corners) {
        if (((*from)[v] > point[v]) != (to[v] > point[v])) {
            const double share = (point[v] - (*from)[v]) / (to[v] - (*from)[v]);
            inside = inside != ((*from)[u] + (to[u] - (*from)[u]) * share > point[u]);
        }
        from = &to;
    }
    return inside;
}

double distance_to_sides(std::span<const glm::dvec3> corners, const glm::dvec3& point) {
    double nearest2 = std::numeric_limits<double>::infinity();
    glm::dvec3 from = corners.back() - point;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 to = corner - point;
        const glm::dvec3 along = to - from;
        const double length2 = glm::dot(along, along);
        const double share = length2 > 0.0 ? std::clamp(-glm::dot(from, along) / length2, 0.0, 1.0) : 0.0;
        const glm::dvec3 nearest = from + along * share;
        nearest2 = std::min(nearest2, glm::dot(nearest, nearest));
        from = to;
    }
    return std::sqrt(nearest2);
}

} // namespace octant::models::polygons
