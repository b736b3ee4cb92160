#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace octant::models::meshfile {

/// Where a node of a scene stands: world = turn * own + shift.
struct AffineTransform {
    glm::dmat3 turn{1.0}; ///< with scales, perhaps mirrored
    glm::dvec3 shift_m{0.0};

    /// Of a child whose placement in this one is `child`.
    AffineTransform of(const AffineTransform& child) const {
        return {turn * child.turn, turn * child.shift_m + shift_m};
    }

    /// Nothing where the point leaves max_coordinate (mesh_limits.h).
    std::optional<glm::dvec3> point_m(const glm::dvec3& own_m) const;

    /// At a right angle to the surface; its length is any. A flat placement has none: zeros.
    glm::dvec3 normal(const glm::dvec3& own) const;

    bool mirrors() const;
};

} // namespace octant::models::meshfile
