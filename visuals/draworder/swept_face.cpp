// Rotors in painting orders. The 1989 paper's 500MD has a rotor, but its orders are for rigid objects; turning_parts.h
// explains the stand-ins that make one order right at every angle.
#include "visuals/draworder/swept_face.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::visuals::draworder {

namespace {

constexpr int ring_corners = 24; ///< The corners of the regular polygon around a circle.
/// From this cosine on a normal counts as parallel to the axis.
constexpr double perpendicular = 1.0 - 1e-10;

/// Appends a regular polygon around a circle about an axis, counter-clockwise about it.
void append_ring(std::vector<glm::dvec3>& corners, const glm::dvec3& middle, const glm::dvec3& axis, double radius) {
    const glm::dvec3 aside = std::abs(axis.x) > 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, axis));
    const glm::dvec3 up = glm::cross(axis, right);
    const double reach = radius / std::cos(pi / ring_corners);
    for (int i = 0; i < ring_corners; ++i) {
        const double angle_rad = 2.0 * pi * i / ring_corners;
        corners.push_back(middle + (right * std::cos(angle_rad) + up * std::sin(angle_rad)) * reach);
    }
}

} // namespace

Face swept_face(const models::polygons::PolygonModel& model, std::size_t polygon, const models::polygons::Pivot& pivot,
    const glm::dvec3& origin_m, double scale, double inset) {
    const glm::dvec3 foot = (pivot.point_m - origin_m) * scale;
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    const double facing = glm::dot(normal, pivot.axis);
    double farthest = 0.0;
    double height_sum = 0.0;
    std::vector<glm::dvec3> rings;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        const glm::dvec3 from_foot = (model.vertices_m[vertex] - origin_m) * scale - foot;
        const double height = glm::dot(from_foot, pivot.axis);
        const double radius = glm::length(from_foot - pivot.axis * height);
        farthest = std::max(farthest, radius);
        height_sum += height;
        append_ring(rings, foot + pivot.axis * height, pivot.axis, std::max(radius, inset));
    }
    if (std::abs(facing) < perpendicular) {
        Face body;
        body.corners = rings;
        body.outline = std::move(rings);
        return body;
    }
    const glm::dvec3 up = pivot.axis * (facing > 0.0 ? 1.0 : -1.0);
    const auto count = static_cast<double>(model.corners(polygon).size());
    const glm::dvec3 middle = foot + pivot.axis * (height_sum / count);
    std::vector<glm::dvec3> disc;
    append_ring(disc, middle, up, farthest);
    return outline_face(disc, {up, -glm::dot(up, middle)}, inset);
}

} // namespace octant::visuals::draworder
