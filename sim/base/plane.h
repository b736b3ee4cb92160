#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace octant {

/// Twice the area of a triangle seen along z, positive when it is counter-clockwise; of vectors of two or three parts.
template <typename Vector>
auto signed_area2(const Vector& a, const Vector& b, const Vector& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// An oriented plane: the points with dot(normal, p) + offset_m = 0. Its front is where that is positive; with a unit
/// normal it is the distance in metres.
struct Plane {
    glm::dvec3 normal{0.0, 0.0, 1.0};
    double offset_m = 0.0;
    bool operator==(const Plane&) const = default;
};

/// Distance of a point from a plane with a unit normal, positive in front of it.
inline double distance_m(const Plane& plane, const glm::dvec3& point_m) {
    return glm::dot(plane.normal, point_m) + plane.offset_m;
}

/// The plane seen from its other side: what was behind it is in front.
inline Plane turned_over(const Plane& plane) { return {-plane.normal, -plane.offset_m}; }

} // namespace octant
