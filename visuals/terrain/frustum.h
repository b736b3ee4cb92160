#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace octant::visuals::terrain {

// Sets of planes through the eye are bits: bit k for normal k.

/// Answer of planes_cutting for a box that is not in sight.
inline constexpr unsigned outside_frustum = 16;

/// Those normals that are not zero.
unsigned planes_of(const std::array<glm::dvec3, 4>& normals);

/// Those of `planes` that a box, eye-relative, is not wholly inside of; outside_frustum when it is
/// wholly outside one of them. Conservative: a box that touches is never outside.
unsigned planes_cutting(
    const std::array<glm::dvec3, 4>& normals,
    unsigned planes,
    const glm::dvec3& centre_m,
    const glm::dvec3& half_extent_m);

} // namespace octant::visuals::terrain
