#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/polish.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace octant::models::simplify {

/// Which way the triangles of a target face: as measure::flipped_area_share looks at it.
class TargetFacing {
public:
    explicit TargetFacing(const PolishTarget& target);

    /// Whether no triangle of the target within twice the distance of the nearest one faces that
    /// way.
    bool is_against(
        const glm::dvec3& place,
        const measure::NearestOnMesh& nearest,
        const glm::dvec3& normal) const;

    /// The nearest place, at most `within` away, of a triangle that faces that way.
    std::optional<glm::dvec3>
    nearest_alike(const glm::dvec3& place, const glm::dvec3& normal, double within) const;

private:
    PolishTarget target_;
    std::vector<glm::dvec3> normals_; ///< of each triangle, as long as twice its area
};

} // namespace octant::models::simplify
