#include "models/triangle_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace octant::models {

Bounds bounds_of(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) {
        return {};
    }
    const glm::dvec3& first_m = mesh.vertices_m[mesh.triangles.front()[0]];
    Bounds bounds{first_m, first_m};
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            bounds.least_m = glm::min(bounds.least_m, mesh.vertices_m[vertex]);
            bounds.most_m = glm::max(bounds.most_m, mesh.vertices_m[vertex]);
        }
    }
    return bounds;
}

double diagonal_m(const TriangleMesh& mesh) {
    const Bounds bounds = bounds_of(mesh);
    return glm::distance(bounds.least_m, bounds.most_m);
}

} // namespace octant::models
