#include "models/simplify/target_facing.h"

#include "models/measure/nearest_point.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace octant::models::simplify {

namespace {

measure::NearestOnTriangle
nearest_on(const WorkingSurface& surface, std::uint32_t face, const glm::dvec3& place) {
    const std::array<glm::dvec3, 3> corners = surface.corner_places(face);
    return measure::nearest_on_triangle(place, corners[0], corners[1], corners[2]);
}

} // namespace

TargetFacing::TargetFacing(const PolishTarget& target)
    : target_(target) {
    for (std::uint32_t face = 0; face < target.surface.mesh.face_slots(); ++face) {
        normals_.push_back(area_vector(target.surface.corner_places(face)));
    }
}

bool TargetFacing::is_against(
    const glm::dvec3& place,
    const measure::NearestOnMesh& nearest,
    const glm::dvec3& normal) const {
    if (!(glm::dot(normals_[nearest.triangle], normal) < 0.0)) {
        return false;
    }
    const double within = 2.0 * std::sqrt(nearest.distance2) + target_.bvh.rounding_m();
    bool against = true;
    target_.bvh.for_each_near(place, within, [&](std::uint32_t face) {
        against = against && (glm::dot(normals_[face], normal) < 0.0 ||
                              nearest_on(target_.surface, face, place).distance2 > within * within);
    });
    return against;
}

std::optional<glm::dvec3> TargetFacing::nearest_alike(
    const glm::dvec3& place, const glm::dvec3& normal, double within) const {
    double least2 = within * within;
    std::optional<glm::dvec3> found;
    target_.bvh.for_each_near(place, within, [&](std::uint32_t face) {
        if (!(glm::dot(normals_[face], normal) > 0.0)) {
            return;
        }
        const measure::NearestOnTriangle nearest = nearest_on(target_.surface, face, place);
        if (nearest.distance2 < least2) {
            least2 = nearest.distance2;
            found = nearest.point;
        }
    });
    return found;
}

} // namespace octant::models::simplify
