#include "models/polygons/polygon_model.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::models::polygons {

glm::dvec3 normal_of(const PolygonModel& model, std::size_t polygon) {
    const auto corners = model.corners(polygon);
    assert(corners.size() >= 3);
    // Taken from the first corner, so that a small polygon far from the origin keeps its digits.
    const glm::dvec3& origin_m = model.vertices_m[corners[0]];
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(model.vertices_m[corners[i]] - origin_m, model.vertices_m[corners[i + 1]] - origin_m);
    }
    return glm::normalize(sum);
}

Plane plane_of(const PolygonModel& model, std::size_t polygon) {
    const glm::dvec3 normal = normal_of(model, polygon);
    glm::dvec3 middle_m(0.0);
    for (const std::uint32_t vertex : model.corners(polygon)) { middle_m += model.vertices_m[vertex]; }
    middle_m /= static_cast<double>(model.corners(polygon).size());
    return {normal, -glm::dot(normal, middle_m)};
}

std::optional<std::uint32_t> pivot_of(const PolygonModel& model, std::size_t polygon) {
    for (std::size_t i = 0; i < model.pivots.size(); ++i) {
        if (model.pivots[i].part == model.polygons[polygon].part) { return static_cast<std::uint32_t>(i); }
    }
    return std::nullopt;
}

glm::dvec3 turned(const Pivot& pivot, const glm::dvec3& point_m, double angle_rad) {
    return pivot.point_m + glm::angleAxis(angle_rad, pivot.axis) * (point_m - pivot.point_m);
}

double radius_m(const PolygonModel& model) {
    double largest = 0.0;
    for (const glm::dvec3& vertex_m : model.vertices_m) { largest = std::max(largest, glm::dot(vertex_m, vertex_m)); }
    return std::sqrt(largest);
}

} // namespace octant::models::polygons
