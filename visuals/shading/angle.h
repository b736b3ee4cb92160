#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace octant::visuals::shading {

/// The angle between two vectors of any length, 0 to pi.
inline double angle_rad(const glm::dvec3& one, const glm::dvec3& other) {
    return std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other));
}

} // namespace octant::visuals::shading
