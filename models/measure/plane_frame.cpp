// Makes the frames that let the distance from a point to a triangle be computed in float without branches, and so for
// several triangles or points at once: a rotation into the plane, a two-dimensional distance to the edges, and the
// height above the plane.
#include "models/measure/plane_frame.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace octant::models::measure {

namespace {

float inverse(double value) { return value > 1e-30 ? static_cast<float>(1.0 / value) : 0.0F; }

/// An edge shorter than this has no direction, because its square loses digits.
constexpr double min_length = 1e-100;
/// A height below this share of an edge's length consists of rounding too much to be perpendicular to the other edge.
constexpr double min_height = 1e-8;

/// Any unit vector perpendicular to a unit vector.
glm::dvec3 across(const glm::dvec3& axis) {
    const glm::dvec3 helper = std::abs(axis.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(axis, helper));
}

} // namespace

PlaneFrame<float> plane_frame(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 ab = corners[1] - corners[0];
    const glm::dvec3 ac = corners[2] - corners[0];
    const double length = glm::length(ab);
    const glm::dvec3 x_axis = length > min_length ? ab / length : glm::dvec3(1.0, 0.0, 0.0);
    const double along = glm::dot(ac, x_axis);
    const glm::dvec3 height = ac - along * x_axis;
    const double up = glm::length(height);
    const glm::dvec3 y_axis = up > min_height * glm::length(ac) ? height / up : across(x_axis);
    PlaneFrame<float> t{};
    t.origin = narrow(corners[0]);
    t.x_axis = narrow(x_axis);
    t.y_axis = narrow(y_axis);
    t.normal = narrow(glm::cross(x_axis, y_axis));
    t.bx = static_cast<float>(length);
    t.cx = static_cast<float>(along);
    t.cy = static_cast<float>(up);
    t.per_ab2 = inverse(length * length);
    t.per_bc2 = inverse((along - length) * (along - length) + up * up);
    t.per_ca2 = inverse(along * along + up * up);
    return t;
}

} // namespace octant::models::measure
