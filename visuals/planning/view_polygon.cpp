#include "visuals/planning/view_polygon.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::visuals::planning {

void clip_to_front(ViewPolygon& polygon, const Plane& plane, double tolerance_m, ViewPolygon& scratch) {
    bool any_behind = false;
    bool any_in_front = false;
    for (const ViewVertex& corner : polygon) {
        const double height_m = distance_m(plane, corner.at_m);
        any_behind = any_behind || height_m < -tolerance_m;
        any_in_front = any_in_front || height_m > tolerance_m;
    }
    if (!any_in_front) { polygon.clear(); }
    if (!any_in_front || !any_behind) { return; }
    scratch.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const ViewVertex& from = polygon[i];
        const ViewVertex& to = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        const double from_height_m = distance_m(plane, from.at_m);
        const double to_height_m = distance_m(plane, to.at_m);
        if (from_height_m >= 0.0) { scratch.push_back(from); }
        if ((from_height_m >= 0.0) != (to_height_m >= 0.0)) {
            const double share = from_height_m / (from_height_m - to_height_m);
            const bool leaves = from_height_m >= 0.0;
            scratch.push_back({from.at_m + (to.at_m - from.at_m) * share, leaves || from.cut});
        }
    }
    polygon.swap(scratch);
}

void clip_to_cone(ViewPolygon& polygon, std::span<const glm::dvec3> normals, ViewPolygon& scratch) {
    for (const glm::dvec3& normal : normals) {
        clip_to_front(polygon, {normal, 0.0}, 0.0, scratch);
        if (polygon.empty()) { return; }
    }
}

void cone_of(const ViewPolygon& polygon, double widening_rad, std::vector<glm::dvec3>& inward_normals) {
    inward_normals.clear();
    const glm::dvec3 middle_m = middle_of(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& from_m = polygon[i].at_m;
        const glm::dvec3& to_m = polygon[i + 1 < polygon.size() ? i + 1 : 0].at_m;
        const glm::dvec3 across = glm::cross(from_m, to_m);
        const double size = glm::length(across);
        if (size <= 1e-12 * glm::length(from_m) * glm::length(to_m)) {
            continue; // the corners lie behind each other: no edge on the screen
        }
        const glm::dvec3 inward = across * ((glm::dot(across, middle_m) < 0.0 ? -1.0 : 1.0) / size);
        const glm::dvec3 along = glm::normalize(from_m) + glm::normalize(to_m);
        inward_normals.push_back(glm::normalize(inward + along * (0.5 * widening_rad)));
    }
}

Plane plane_of(const ViewPolygon& polygon) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        sum += glm::cross(polygon[i].at_m - polygon[0].at_m, polygon[i + 1].at_m - polygon[0].at_m);
    }
    const double size = glm::length(sum);
    if (size == 0.0) { return {glm::dvec3(0.0), 0.0}; }
    const glm::dvec3 normal = sum / size;
    return {normal, -glm::dot(normal, middle_of(polygon))};
}

glm::dvec3 middle_of(const ViewPolygon& polygon) {
    glm::dvec3 sum(0.0);
    for (const ViewVertex& corner : polygon) { sum += corner.at_m; }
    return sum / static_cast<double>(std::max<std::size_t>(polygon.size(), 1));
}

double solid_angle_sr(const ViewPolygon& polygon) {
    double sum_sr = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[0].at_m;
        const glm::dvec3& b = polygon[i].at_m;
        const glm::dvec3& c = polygon[i + 1].at_m;
        const double sizes = glm::length(a) * glm::length(b) * glm::length(c);
        sum_sr += sizes > 0.0 ? std::abs(glm::dot(a, glm::cross(b, c))) / (2.0 * sizes) : 0.0;
    }
    return sum_sr;
}

} // namespace octant::visuals::planning
