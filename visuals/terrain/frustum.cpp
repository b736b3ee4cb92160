// View frustum culling of boxes. Once a box is inside a plane, so are all boxes within it; a walk down a tree therefore
// passes on the planes that still need a test, and tests none below a node that is wholly inside.
#include "visuals/terrain/frustum.h"

#include <glm/geometric.hpp>

#include <cstddef>

namespace octant::visuals::terrain {

namespace {

/// A box this far outside is still drawn, which is more than double arithmetic can be wrong by.
constexpr double cull_margin_m = 1e-3;

} // namespace

unsigned active_planes(const std::array<glm::dvec3, 4>& normals) {
    unsigned planes = 0;
    for (std::size_t k = 0; k < normals.size(); ++k) { planes |= normals[k] == glm::dvec3(0.0) ? 0U : 1U << k; }
    return planes;
}

unsigned crossed_planes(const std::array<glm::dvec3, 4>& normals, unsigned planes, const glm::dvec3& centre_m,
    const glm::dvec3& half_extent_m) {
    unsigned cutting = 0;
    for (std::size_t k = 0; k < normals.size(); ++k) {
        if ((planes >> k & 1U) == 0) { continue; }
        const double middle_m = glm::dot(normals[k], centre_m);
        const double radius_m = glm::dot(glm::abs(normals[k]), half_extent_m) + cull_margin_m;
        if (middle_m < -radius_m) { return outside_frustum; }
        cutting |= middle_m < radius_m ? 1U << k : 0U;
    }
    return cutting;
}

} // namespace octant::visuals::terrain
