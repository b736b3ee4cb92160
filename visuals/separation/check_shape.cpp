// Prepares polygons for the certificate (order_check.cpp). Rotor blades and other turning parts are replaced by what
// they sweep, so that one certificate holds for every angle. This code is deliberately apart from turning_parts.cpp,
// which does the same for finding orders.
#include "visuals/separation/check_shape.h"

#include "sim/base/plane.h"
#include "sim/base/units.h"
#include "visuals/separation/separation.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::visuals::separation {

namespace {

/// The number of sides of the regular polygon around a circle on which a corner travels; its corners are 0.9 % outside
/// the circle.
constexpr int circle_sides = 24;
/// The sine of the angle below which a normal counts as parallel to the axis.
constexpr double along_axis = 1e-9;

/// Moves corners towards their mean by check_tolerance.
std::vector<glm::dvec3> drawn_together(std::vector<glm::dvec3> corners) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) { middle += corner / static_cast<double>(corners.size()); }
    for (glm::dvec3& corner : corners) {
        const double away = glm::distance(corner, middle);
        corner += (middle - corner) * std::min(0.5, check_tolerance / away);
    }
    return corners;
}

/// An axis of rotation with two unit vectors perpendicular to it.
struct Axis {
    glm::dvec3 point{0.0};
    glm::dvec3 along{0.0};
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};

    /// The unit vector perpendicular to the axis at one of circle_sides angles.
    glm::dvec3 across(int side) const {
        const double angle_rad = 2.0 * pi * side / circle_sides;
        return right * std::cos(angle_rad) + up * std::sin(angle_rad);
    }
};

Axis axis_of(const models::polygons::Pivot& pivot, const CheckFrame& frame) {
    const glm::dvec3 aside = std::abs(pivot.axis.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, pivot.axis));
    return {frame.from_body(pivot.point_m), pivot.axis, right, glm::cross(pivot.axis, right)};
}

/// The radius of a regular polygon's corners around a unit circle.
const double outside_circle = 1.0 / std::cos(pi / circle_sides);

/// Points whose hull holds what the corners sweep: regular polygons around their circles, of circles at the same height
/// only the widest.
std::vector<glm::dvec3> swept_by(const Axis& axis, std::span<const glm::dvec3> corners) {
    struct Ring {
        double height;
        double radius;
    };

    std::vector<Ring> rings;
    for (const glm::dvec3& corner : corners) {
        const double height = glm::dot(corner - axis.point, axis.along);
        const double radius = glm::length(corner - axis.point - axis.along * height);
        const auto same =
            std::ranges::find_if(rings, [&](const Ring& ring) { return std::abs(ring.height - height) < 1e-12; });
        if (same == rings.end()) {
            rings.push_back({height, radius});
        } else {
            same->radius = std::max(same->radius, radius);
        }
    }
    std::vector<glm::dvec3> points;
    for (const Ring& ring : rings) {
        for (int side = 0; side < circle_sides; ++side) {
            points.push_back(
                axis.point + axis.along * ring.height + axis.across(side) * (ring.radius * outside_circle));
        }
    }
    return points;
}

/// The planes that replace a polygon's plane for all angles. As it turns, its value at an eye e is n.e + d = (part
/// along the axis) + (part across the axis) * cos(angle to e) * |distance of e from the axis|. The maximum over all
/// angles is at most that over circle_sides directions with the part across made slightly longer.
std::vector<Plane> swept_planes(const Axis& axis, const Plane& plane) {
    const double along = glm::dot(plane.normal, axis.along);
    const double across = glm::length(plane.normal - axis.along * along);
    if (across < along_axis) { return {plane}; }
    const double at_point = distance_m(plane, axis.point);
    std::vector<Plane> planes;
    for (int side = 0; side < circle_sides; ++side) {
        glm::dvec3 normal = axis.along * along + axis.across(side) * (across * outside_circle);
        const double length = glm::length(normal);
        normal /= length;
        planes.push_back({normal, at_point / length - glm::dot(normal, axis.point)});
    }
    return planes;
}

} // namespace

CheckFrame check_frame(const models::polygons::PolygonModel& model) {
    glm::dvec3 least(model.vertices_m[model.corner_vertices.front()]);
    glm::dvec3 most = least;
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, model.vertices_m[vertex]);
        most = glm::max(most, model.vertices_m[vertex]);
    }
    return {(least + most) * 0.5, glm::distance(least, most)};
}

std::vector<CheckShape> check_shapes(
    const models::polygons::PolygonModel& model, const CheckFrame& frame, std::span<const std::uint32_t> two_sided) {
    std::vector<CheckShape> shapes;
    for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
        CheckShape shape;
        for (const std::uint32_t vertex : model.corners(i)) {
            shape.corners.push_back(frame.from_body(model.vertices_m[vertex]));
        }
        shape.corners = drawn_together(std::move(shape.corners));
        const Plane plane = frame.from_body(models::polygons::plane_of(model, i));
        shape.fronts = {plane};
        if (std::ranges::find(two_sided, i) != two_sided.end()) { shape.fronts.push_back(turned_over(plane)); }
        shape.pivot = models::polygons::pivot_of(model, i);
        shape.swept = shape.corners;
        shape.swept_fronts = shape.fronts;
        if (shape.pivot) {
            const Axis axis = axis_of(model.pivots[*shape.pivot], frame);
            shape.swept = swept_by(axis, shape.corners);
            shape.swept_fronts.clear();
            for (const Plane& front : shape.fronts) {
                const auto planes = swept_planes(axis, front);
                shape.swept_fronts.insert(shape.swept_fronts.end(), planes.begin(), planes.end());
            }
        }
        shapes.push_back(std::move(shape));
    }
    return shapes;
}

} // namespace octant::visuals::separation
