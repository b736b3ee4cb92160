#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace octant::visuals::terrain {

/// 1 / (2 R); 0 for R = 0, which stands for a flat earth.
inline double half_curvature(double radius_m) { return radius_m > 0.0 ? 0.5 / radius_m : 0.0; }

/// By how much the ground is lowered at a horizontal distance d from the eye, given as its square: d^2 / (2 R).
inline double curvature_drop_m(double distance_squared_m2, double radius_m) {
    return half_curvature(radius_m) * distance_squared_m2;
}

// The view frustum is given by the normals of four planes through the eye. A set of planes is a bit mask: bit k stands
// for normal k.

/// The answer of crossed_planes for a box that is not in sight.
inline constexpr unsigned outside_frustum = 16;

/// The set of those planes whose normals are not zero.
unsigned active_planes(const std::array<glm::dvec3, 4>& normals);

/// Those of `planes` that a box (relative to the eye) is not wholly inside of; outside_frustum if it is wholly outside
/// one of them. Conservative: a box that touches is never outside.
unsigned crossed_planes(const std::array<glm::dvec3, 4>& normals, unsigned planes, const glm::dvec3& centre_m,
    const glm::dvec3& half_extent_m);

} // namespace octant::visuals::terrain
