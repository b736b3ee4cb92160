// Keeps steps from folding the surface over: the test of the angle between old and new normal of M.
// Garland and P. Heckbert (1997). Slivers are allowed where the error allows them: along cylinders
// and rims they lie best. The topology has a test of its own, CollapsibleMesh::may_collapse.
#include "models/simplify/collapse_guard.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace octant::models::simplify {

bool may_become(
    const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after) {
    const glm::dvec3 old_normal = area_vector(before);
    const glm::dvec3 new_normal = area_vector(after);
    if (!(glm::dot(new_normal, new_normal) > 0.0)) {
        return false;
    }
    return !(glm::dot(old_normal, old_normal) > 0.0) || glm::dot(old_normal, new_normal) > 0.0;
}

bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before,
    const std::array<std::array<glm::dvec3, 3>, 2>& after) {
    return std::ranges::all_of(before, [&](const auto& from) {
        return std::ranges::all_of(after, [&](const auto& to) { return may_become(from, to); });
    });
}

bool may_move(
    const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place) {
    return std::ranges::all_of(ring, [&](const RingFace& face) {
        const glm::dvec3& old_place = surface.places[surface.mesh.origin(face.half_edge)];
        return may_become(
            moved_corners(surface, face, old_place), moved_corners(surface, face, place));
    });
}

} // namespace octant::models::simplify
